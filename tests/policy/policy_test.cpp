// What is true of every policy of the registry.
#include "mis/policy/light_choice.h"

#include "mis/policy/registry.h"

#include "tests/policy/prepared.h"
#include "tests/support/lanes.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>

namespace mis {
namespace {

const Vec3<double> x{0, 0, 0}, up{0, 1, 0};

/// What rounds: an alias table keeps its probabilities as floats.
constexpr double rounding = 2e-7;

enum class Numbers : std::uint8_t { doubles, floats, lanes, wide_lanes };

using Table = std::unique_ptr<const PreparedPoint>;

/// A policy of the registry. prepare: one for each of Numbers.
struct TestedPolicy {
    std::string_view name;
    std::array<Table (*)(const Lights&, const Vec3<double>& x, const Vec3<double>& n,
                         const Vec3<double>& origin),
               4>
        prepare;
};

void PrintTo(const TestedPolicy& policy, std::ostream* out) { *out << policy.name; }

template <class P, class T>
Table prepared(const Lights& lights, const Vec3<double>& at, const Vec3<double>& n,
               const Vec3<double>& origin)
{
    return std::make_unique<const Prepared<P, T>>(lights, at, n, origin);
}

std::vector<TestedPolicy> choosing_policies()
{
    std::vector<TestedPolicy> list;
    for_each_type(Policies{}, [&]<class P>() {
        if (!P::draws_every_light)
            list.push_back({P::name,
                            {prepared<P, double>, prepared<P, float>, prepared<P, TestLanes<float>>,
                             prepared<P, TestLanes<double>>}});
    });
    return list;
}

class EveryPolicy : public testing::TestWithParam<TestedPolicy> {
protected:
    /// At a point that looks up.
    static Table table_of(const Lights& lights, Numbers numbers = Numbers::doubles)
    {
        return table_at(x, up, lights, numbers);
    }
    static Table table_at(const Vec3<double>& at, const Vec3<double>& n, const Lights& lights,
                          Numbers numbers = Numbers::doubles)
    {
        return table_from(at, at, n, lights, numbers);
    }
    /// origin: of the lights' columns.
    static Table table_from(const Vec3<double>& origin, const Vec3<double>& at,
                            const Vec3<double>& n, const Lights& lights, Numbers numbers)
    {
        return GetParam().prepare.at(static_cast<std::size_t>(numbers))(lights, at, n, origin);
    }
};
INSTANTIATE_TEST_SUITE_P(Policies, EveryPolicy, testing::ValuesIn(choosing_policies()),
                         [](const auto& of) {
                             std::string name(of.param.name);
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST_P(EveryPolicy, DrawsEachLightAsOftenAsItSays)
{
    const int draws = scaled(1'000'000);
    constexpr double false_alarm = 1e-6;  // per policy
    const Lights lights = thirty_lights_one_dark();
    const Table table = table_of(lights);
    std::vector<double> observed(lights.size()), expected = table->probabilities();
    for (double& e : expected) e *= draws;
    for (int i = 0; i < draws; ++i) {
        const Choice choice = table->choose(random_bits(7, static_cast<std::uint64_t>(i)));
        ASSERT_GE(choice.light, 0);
        ASSERT_EQ(choice.probability, table->probability(static_cast<std::size_t>(choice.light)));
        ++observed[static_cast<std::size_t>(choice.light)];
    }
    EXPECT_GT(chi2_p_value(observed, expected), false_alarm);
}

/// The twin: a probability that is told 10 % too large is seen by the same number of draws.
TEST_P(EveryPolicy, TheSameTestSeesAProbabilityThatIs10PercentOff)
{
    const int draws = scaled(1'000'000);
    const Lights lights = thirty_lights_one_dark();
    const Table table = table_of(lights);
    std::vector<double> observed(lights.size()), expected = table->probabilities();
    *std::max_element(expected.begin(), expected.end()) *= sample_share < 1 ? 1.4 : 1.1;
    for (double& e : expected) e *= draws;
    for (int i = 0; i < draws; ++i) {
        const LightIndex j = table->choose(random_bits(7, static_cast<std::uint64_t>(i))).light;
        ASSERT_GE(j, 0);
        ++observed[static_cast<std::size_t>(j)];
    }
    EXPECT_LT(chi2_p_value(observed, expected), 1e-6);
}

TEST_P(EveryPolicy, ProbabilitiesSumTo1)
{
    const Lights lights = thirty_lights_one_dark();
    EXPECT_NEAR(table_of(lights, Numbers::doubles)->sum(), 1, rounding);
    EXPECT_NEAR(table_of(lights, Numbers::floats)->sum(), 1, rounding);
}

/// What a policy may see is the light's solid angle, radiance and place over the horizon: no unit,
/// axis or order.
TEST_P(EveryPolicy, DoesNotDependOnUnitsAxesPlaceOrOrder)
{
    const Lights lights = thirty_lights_one_dark();
    const std::vector<double> usual = table_of(lights)->probabilities();
    const auto expect_usual = [&](const std::vector<double>& found, const char* what) {
        for (std::size_t j = 0; j < usual.size(); ++j)
            EXPECT_NEAR(found[j], usual[j], rounding * usual[j] + 1e-9 * rounding)
                << what << ", light " << j;
    };
    for (const double scale : {1e-6, 1e6}) {
        Lights scaled_lights = lights;
        for (Light& l : scaled_lights)
            l.center *= scale, l.radius *= scale, l.radiance_radius *= static_cast<float>(scale);
        expect_usual(table_of(scaled_lights)->probabilities(), "scaled");
    }
    const Frame<double> turn = frame_around(normalized(Vec3<double>{1, 2, -2}));
    Lights turned = lights, moved = lights, reversed(lights.rbegin(), lights.rend());
    const Vec3<double> far(1e3, -1e3, 5e2);
    for (Light& l : turned) l.center = turn.to_world(l.center);
    for (Light& l : moved) l.center += far;
    expect_usual(table_at(x, turn.to_world(up), turned)->probabilities(), "turned");
    expect_usual(table_at(far, up, moved)->probabilities(), "moved");
    std::vector<double> backwards = table_of(reversed)->probabilities();
    std::reverse(backwards.begin(), backwards.end());
    expect_usual(backwards, "reversed");
}

TEST_P(EveryPolicy, OfBlackLightsAloneEitherSumsTo1OrDrawsNone)
{
    Lights lights = thirty_lights_one_dark();
    for (Light& l : lights) l.radiance_radius = Vec3<float>(0);
    const Table table = table_of(lights);
    if (table->sum() == 0) {
        EXPECT_EQ(table->choose(random_bits(1, 1)).light, no_light);
        EXPECT_EQ(table->choose(random_bits(1, 1)).probability, 0);
    } else {
        EXPECT_NEAR(table->sum(), 1, rounding);
    }
}

TEST_P(EveryPolicy, WithoutALightDrawsNone)
{
    const Table table = table_of(Lights{});
    EXPECT_EQ(table->choose(random_bits(1, 1)).light, no_light);
    EXPECT_EQ(table->choose(random_bits(1, 1)).probability, 0);
}

/// Above the horizon and not black: it can be drawn, even when outshone by 1e12 or outsized by 1e8.
TEST_P(EveryPolicy, ALightThatCanContributeHasAProbability)
{
    const Lights bright{make_light({0, 2, 0}, 0.1, Vec3<double>(1)),
                        make_light({1, 2, 0}, 0.1, Vec3<double>(1e12))};
    const Lights big{make_light({0, 2, 0}, 1e-8, Vec3<double>(1)),
                     make_light({1, 2, 0}, 1, Vec3<double>(1))};
    for (const Lights& lights : {bright, big}) {
        const Table table = table_of(lights, Numbers::floats);
        EXPECT_GT(table->probability(0), 0);
        EXPECT_NEAR(table->sum(), 1, rounding);
    }
}

/// However little it weighs beside what is listed before it.
TEST_P(EveryPolicy, ALightListedAfterOneThatOutweighsItHasAProbability)
{
    const Lights bright{make_light({0, 2, 0}, 0.1, Vec3<double>(1e18)),
                        make_light({1, 2, 0}, 0.1, Vec3<double>(1)),
                        make_light({0, 2, 1}, 0.1, Vec3<double>(1))};
    const Lights big{make_light({0, 2, 0}, 0.5, Vec3<double>(1)),
                     make_light_of_power({1, 2, 0}, 1e-15, Vec3<double>(5)),
                     make_light_of_power({0, 2, 1}, 1e-15, Vec3<double>(5))};
    for (const Lights& lights : {bright, big})
        for (const Numbers numbers : {Numbers::floats, Numbers::doubles, Numbers::lanes}) {
            const Table table = table_of(lights, numbers);
            EXPECT_GT(table->probability(1), 0);
            EXPECT_GT(table->probability(2), 0);
            EXPECT_NEAR(table->sum(), 1, rounding);
        }
}

/// A radius whose square is no float, with the power of a lamp.
TEST_P(EveryPolicy, ARadiusOf1e20IsALightLikeAnyOther)
{
    const Lights lights{make_light_of_power({0, 2, 0}, 1e-20, Vec3<double>(5)),
                        make_light_of_power({0, -1, 2}, 1e-20, Vec3<double>(5)),
                        make_light_of_power({1, 2, 0}, 2e-20, Vec3<double>(5))};
    const Table in_float = table_of(lights, Numbers::floats),
                in_double = table_of(lights, Numbers::doubles);
    EXPECT_NEAR(in_float->sum(), 1, rounding);
    EXPECT_GT(in_float->probability(0), 0);
    for (std::size_t j = 0; j < lights.size(); ++j)
        EXPECT_NEAR(in_float->probability(j), in_double->probability(j), 1e-6);
}

/// However little of it is above the horizon: rounding must not put it below.
TEST_P(EveryPolicy, ALightWhoseRimIsAboveTheHorizonHasAProbability)
{
    for (const Numbers numbers :
         {Numbers::floats, Numbers::doubles, Numbers::lanes, Numbers::wide_lanes})
        for (const double s : {1e-20, 1e-8, 1e-4, 0.1, 0.5, 0.9, 0.999})
            for (const double share : {1.0, 0.1, 1e-3, 1e-6, 1e-9, 1e-12})
                for (const double away : {0.0, 1e3}) {
                    const Lights lights{low_light(x, s, share * s)};
                    const Vec3<double> origin(away, -away, away);
                    const Table table = table_from(origin, x, up, lights, numbers);
                    EXPECT_NEAR(table->sum(), 1, rounding) << s << " " << share << " " << away;
                    EXPECT_EQ(table->choose(5).light, 0);
                }
}

TEST_P(EveryPolicy, FloatAndLanesAgreeWithDouble)
{
    const Lights lights = thirty_lights_one_dark();
    const auto by = [&](Numbers numbers) { return table_of(lights, numbers)->probabilities(); };
    const std::vector<double> exact = by(Numbers::doubles), one = by(Numbers::floats),
                              lanes = by(Numbers::lanes), wide = by(Numbers::wide_lanes);
    for (std::size_t j = 0; j < lights.size(); ++j) {
        EXPECT_NEAR(one[j], exact[j], 2e-6 * exact[j] + 1e-12) << j;
        EXPECT_NEAR(lanes[j], exact[j], 2e-6 * exact[j] + 1e-12) << j;
        EXPECT_NEAR(wide[j], exact[j], 1e-12 * exact[j] + 1e-20) << j;
    }
}

/// The loop over lanes ends with a group that is not full, whatever the number of lights.
TEST_P(EveryPolicy, AnyNumberOfLightsFillsTheLanes)
{
    const Lights all = thirty_lights_one_dark();
    double sums = 0;
    for (std::size_t count = 1; count <= 19; ++count) {
        const Lights lights(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
        const double one_by_one = table_of(lights, Numbers::floats)->sum();
        EXPECT_NEAR(table_of(lights, Numbers::lanes)->sum(), one_by_one, rounding) << count;
        EXPECT_NEAR(one_by_one, one_by_one > 0 ? 1 : 0, rounding);
        sums += one_by_one;
    }
    EXPECT_GT(sums, 9);
}

/// Lights about the point, half of them below it, every eleventh black.
Lights many_lights(std::size_t count)
{
    Uniforms u(5);
    Lights lights;
    for (std::size_t j = 0; j < count; ++j) {
        const Vec3<double> center{u.between(-9, 9), u.between(-9, 9), u.between(-9, 9)};
        lights.push_back(
            make_light_of_power(center, std::min(u.log_between(1e-4, 0.1), 0.5 * length(center)),
                                Vec3<double>(j % 11 == 5 ? 0 : u.log_between(1, 1e3))));
    }
    return lights;
}

/// Tables of some lights, of hundreds, and of so many that weights are not kept; with a block that
/// is not full at their end.
TEST_P(EveryPolicy, OfAnyNumberOfLightsATableSaysWhatItDraws)
{
    for (const std::size_t count : {32U, 33U, 64U, 1'003U, 16'384U, 16'387U}) {
        const Lights lights = many_lights(count);
        for (const Numbers numbers : {Numbers::doubles, Numbers::floats, Numbers::lanes}) {
            const Table table = table_of(lights, numbers);
            const std::vector<double> all = table->probabilities();
            EXPECT_NEAR(table->sum(), 1, rounding) << count;
            double below = 0;
            for (std::size_t j = 0; j < count; ++j) {
                ASSERT_GE(all[j], 0);
                below += all[j];
            }
            ASSERT_GT(below, 0);
            for (int i = 0; i < 1000; ++i) {
                const std::uint64_t bits = random_bits(3, static_cast<std::uint64_t>(i));
                const Choice choice = table->choose(bits);
                ASSERT_GE(choice.light, 0);
                ASSERT_LT(static_cast<std::size_t>(choice.light), count);
                ASSERT_GT(choice.probability, 0);
                ASSERT_EQ(choice.probability, all[static_cast<std::size_t>(choice.light)]);
            }
        }
    }
}

TEST_P(EveryPolicy, DrawsHundredsOfLightsEachAsOftenAsItSays)
{
    const int draws = scaled(300'000);
    constexpr double false_alarm = 1e-6;  // per policy
    const Lights lights = many_lights(333);
    const Table table = table_of(lights, Numbers::lanes);
    std::vector<double> observed(lights.size()), expected = table->probabilities();
    for (double& e : expected) e *= draws;
    for (int i = 0; i < draws; ++i)
        ++observed[static_cast<std::size_t>(
            table->choose(random_bits(7, static_cast<std::uint64_t>(i))).light)];
    EXPECT_GT(chi2_p_value(observed, expected), false_alarm);
}

}  // namespace
}  // namespace mis
