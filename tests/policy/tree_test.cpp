// What the choice by a hierarchy says of each light, next to what `product` says.
#include "mis/policy/tree.h"

#include "mis/bsdf/registry.h"
#include "mis/policy/product.h"

#include "tests/policy/prepared.h"
#include "tests/support/lanes.h"
#include "tests/support/statistics.h"
#include "tests/support/typed.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <functional>

#include <cmath>
#include <map>

namespace mis {
namespace {

const Vec3<double> x{0.1, -0.2, 0.3}, n = normalized(Vec3<double>{0.2, 1, -0.1});
const Vec3<double> wo = normalized(n + Vec3<double>{0.5, 0.1, 0.3});

/// Lights all around x, half of them below its horizon, radii and powers over three decades, every
/// eleventh black. More than can be opened at one point.
Lights lights_around(int count)
{
    Uniforms u(11);
    Lights lights;
    for (int j = 0; j < count; ++j) {
        const Vec3<double> center{u.between(-9, 9), u.between(-9, 9), u.between(-9, 9)};
        const double radius = std::min(u.log_between(1e-4, 0.1), 0.5 * length(center - x));
        lights.push_back(make_light_of_power(
            center, radius, Vec3<double>(j % 11 == 5 ? 0 : u.log_between(1, 1e3))));
    }
    return lights;
}

struct Surface {
    const char* what;
    Material material;
    std::shared_ptr<const void> object;
    AnyBsdf view;
    Surface(const char* type, double exponent, double alpha) : what(type)
    {
        material.type = type, material.exponent = exponent, material.alpha = alpha;
        material.diffuse = Vec3<double>(0.1), material.specular = Vec3<double>(0.6);
        object = make_bsdf(material);
        view = {object.get(), bsdf_number(material.type)};
    }
};

std::vector<Surface> surfaces()
{
    return {{"lambert", 0, 0},   {"blinn", 20, 0}, {"blinn", 500, 0},
            {"lecture", 100, 0}, {"ggx", 0, 0.3},  {"ggx", 0, 0.05}};
}

template <class P, class T = double>
Prepared<P, T> table_of(const Lights& lights, const AnyBsdf& bsdf)
{
    return {lights, x, n, x, wo, bsdf};
}

/// Variance of Y/P over its squared mean, where the lights are worth what `product` says.
double excess(const std::vector<double>& worth, const std::vector<double>& probability)
{
    double sum = -1;
    for (std::size_t j = 0; j < worth.size(); ++j)
        if (worth[j] > 0) sum += worth[j] * worth[j] / probability[j];
    return sum;
}

TEST(TreePolicy, OfSomeHundredLightsIsProduct)
{
    const Lights lights = lights_around(330);
    for (const Surface& s : surfaces()) {
        const auto found = table_of<TreePolicy>(lights, s.view);
        const auto exact = table_of<ProductPolicy>(lights, s.view);
        for (std::size_t j = 0; j < lights.size(); ++j)
            ASSERT_NEAR(found.probability(j), exact.probability(j),
                        1e-9 * exact.probability(j) + 1e-15)
                << s.what << " " << j;
    }
}

/// 20 000 lights at which 24 groups are looked into: 0.01 to 0.2 are measured, the most at sharp
/// lobes.
TEST(TreePolicy, OfManyLightsHasLittleMoreVarianceThanProduct)
{
    const Lights lights = lights_around(20'000);
    for (const Surface& s : surfaces()) {
        const double found = excess(table_of<ProductPolicy>(lights, s.view).probabilities(),
                                    table_of<TreePolicy>(lights, s.view).probabilities());
        EXPECT_GT(found, 0) << s.what;
        EXPECT_LT(found, 0.25) << s.what;
    }
}

/// Excess at some places of the plane y = 0, not farther than `reach` from the middle, seen from
/// above: the largest.
double worst_excess(const Lights& lights, double reach, const AnyBsdf& bsdf)
{
    Uniforms u(5);
    const Vec3<double> up{0, 1, 0};
    double worst = 0;
    for (int i = 0; i < 12; ++i) {
        const Vec3<double> at{u.between(-reach, reach), 0, u.between(-reach, reach)},
            to_viewer = normalized(Vec3<double>{u.between(-1, 1), 1, u.between(-1, 1)});
        const Prepared<ProductPolicy> exact(lights, at, up, at, to_viewer, bsdf);
        const Prepared<TreePolicy> found(lights, at, up, at, to_viewer, bsdf);
        worst = std::max(worst, excess(exact.probabilities(), found.probabilities()));
    }
    return worst;
}

Lights lamps_over_a_plain(int count, double half_width)
{
    Uniforms u(3);
    Lights lights;
    for (int j = 0; j < count; ++j)
        lights.push_back(make_light_of_power({u.between(-half_width, half_width), u.between(2, 4),
                                              u.between(-half_width, half_width)},
                                             1e-3, Vec3<double>(u.log_between(1, 100))));
    return lights;
}

/// A few lamps far away stand in groups with near ones, which are far nearer than such a group's
/// mean square distance: up to 7e8 where nothing looks into it.
TEST(TreePolicy, FarLampsDoNotHideTheNearOnesOfTheirGroups)
{
    Uniforms u(4);
    Lights lights = lamps_over_a_plain(1'000, 10);
    for (int j = 0; j < 10; ++j) {
        const double d = u.log_between(1e3, 1e4), azimuth = u.between(0, 6.28);
        lights.push_back(make_light_of_power(
            {d * std::cos(azimuth), 0.3 * d, d * std::sin(azimuth)}, 0.01, Vec3<double>(50)));
    }
    for (const Surface& s : surfaces()) EXPECT_LT(worst_excess(lights, 8, s.view), 0.1) << s.what;
}

/// Lamps at all distances up to a thousand times the nearest.
TEST(TreePolicy, OfLampsAtAllDistancesHasLittleMoreVarianceThanProduct)
{
    Uniforms u(6);
    Lights lights;
    for (int j = 0; j < 3'000; ++j) {
        const double d = u.log_between(1, 1e3), z = u.between(0.02, 1),
                     azimuth = u.between(0, 6.28), s = std::sqrt(1 - z * z);
        lights.push_back(
            make_light_of_power({d * s * std::cos(azimuth), d * z, d * s * std::sin(azimuth)},
                                1e-3 * d, Vec3<double>(u.log_between(1, 100))));
    }
    EXPECT_LT(worst_excess(lights, 0.5, {}), 0.2);
}

/// Of a layer of lamps around the point, much of the light comes from groups whose mean place is at
/// the horizon.
TEST(TreePolicy, OfASparsePlainHasLittleMoreVarianceThanProduct)
{
    EXPECT_LT(worst_excess(lamps_over_a_plain(1'000, 100), 80, {}), 0.02);
    EXPECT_LT(worst_excess(lamps_over_a_plain(30'000, 500), 400, {}), 0.05);
}

/// A view along the surface, where a lobe's peak is beyond what a float can hold.
TEST(TreePolicy, DrawsALightHoweverGrazingTheViewIs)
{
    const Surface sharp("ggx", 0, 1e-9);
    const Lights lights = lights_around(2'000);
    for (const double cosine : {1e-3, 1e-13, 1e-20}) {
        const Vec3<double> grazing =
            normalized(cross(n, Vec3<double>{0, 0, 1})) * std::sqrt(1 - cosine * cosine) +
            n * cosine;
        const Prepared<TreePolicy, float> in_float(lights, x, n, x, grazing, sharp.view);
        const Prepared<TreePolicy> in_double(lights, x, n, x, grazing, sharp.view);
        EXPECT_NEAR(in_float.sum(), 1, 1e-3) << cosine;
        EXPECT_NEAR(in_double.sum(), 1, 1e-9) << cosine;
    }
}

/// So that a light of weight 0 has probability 0, to the bit.
TEST(TreePolicy, SumsOfAGroupNeverFallAndStayWhereTheWeightIs0)
{
    Uniforms u(8);
    for (int i = 0; i < 20'000; ++i) {
        LightTree::Row<double> weights{};
        for (double& w : weights) w = u.between(0, 1) < 0.4 ? 0 : u.log_between(1e-9, 1);
        LightTree::Row<double> sums = weights;
        const bool is_any = sum_up(sums);
        ASSERT_EQ(is_any, sums.back() > 0);
        for (std::size_t k = 0; k < weights.size(); ++k) {
            const double before = k > 0 ? sums[k - 1] : 0;
            if (weights[k] == 0) ASSERT_EQ(sums[k], before) << i << " " << k;
            else ASSERT_GT(sums[k], before) << i << " " << k;
        }
    }
}

TEST(TreePolicy, ProbabilitiesOfManyLightsSumTo1)
{
    const Lights lights = lights_around(6'000);
    for (const Surface& s : surfaces()) {
        EXPECT_NEAR(table_of<TreePolicy>(lights, s.view).sum(), 1, 1e-12) << s.what;
        EXPECT_NEAR((table_of<TreePolicy, float>(lights, s.view).sum()), 1, 1e-12);
        EXPECT_NEAR((table_of<TreePolicy, TestLanes<float>>(lights, s.view).sum()), 1, 1e-12);
        EXPECT_NEAR((table_of<TreePolicy, TestLanes<double>>(lights, s.view).sum()), 1, 1e-12);
    }
}

template <class T> void expect_as_many_draws_as_said()
{
    const int draws = scaled(100'000);
    constexpr double false_alarm = 1e-6;  // each
    const Lights lights = lights_around(6'000);
    for (const Surface& s : surfaces()) {
        const auto table = table_of<TreePolicy, T>(lights, s.view);
        std::vector<double> observed(lights.size()), expected = table.probabilities();
        for (double& e : expected) e *= draws;
        for (int i = 0; i < draws; ++i) {
            const Choice choice = table.choose(random_bits(7, static_cast<std::uint64_t>(i)));
            ASSERT_GE(choice.light, 0);
            ASSERT_EQ(choice.probability,
                      table.probability(static_cast<std::size_t>(choice.light)));
            ++observed[static_cast<std::size_t>(choice.light)];
        }
        EXPECT_GT(chi2_p_value(observed, expected), false_alarm) << s.what;
    }
}
TEST(TreePolicy, DrawsOfManyLightsEachAsOftenAsItSays) { expect_as_many_draws_as_said<double>(); }
TEST(TreePolicy, DrawsInLanesOfManyLightsEachAsOftenAsItSays)
{
    expect_as_many_draws_as_said<TestLanes<float>>();
}

/// At points of two surfaces, one after the other, and of no light.
template <class T> void expect_draws_together_to_be_as_one_by_one()
{
    constexpr std::size_t draws = 256;
    const Lights lights = lights_around(20'000);
    const auto all = surfaces();
    const auto dull = table_of<TreePolicy, T>(lights, all[0].view),
               sharp = table_of<TreePolicy, T>(lights, all[5].view),
               dark = table_of<TreePolicy, T>({}, all[0].view);
    const auto at = [&](std::size_t i) -> const auto&
    {
        return i % 100 < 40 ? dull : i % 100 < 90 ? sharp : dark;
    };
    std::vector<std::uint64_t> bits;
    for (std::size_t i = 0; i < draws; ++i) bits.push_back(random_bits(3, i));
    std::vector<int> times(draws, 0);
    using Table = std::remove_cvref_t<decltype(dull.table())>;
    Table::template choose_each<draws>(
        bits, [&](std::size_t i) -> const Table& { return at(i).table(); },
        [&](std::size_t i, const Choice& choice) {
            ++times[i];
            EXPECT_EQ(choice.light, at(i).choose(bits[i]).light) << i;
            EXPECT_EQ(choice.probability, at(i).choose(bits[i]).probability) << i;
        });
    EXPECT_EQ(times, std::vector<int>(draws, 1));
}
TEST(TreePolicy, DrawsTogetherAsOneByOne)
{
    expect_draws_together_to_be_as_one_by_one<double>();
    expect_draws_together_to_be_as_one_by_one<TestLanes<float>>();
}

/// However little of it is above the horizon, and however far below its neighbours are.
TEST(TreePolicy, ALightThatProductDrawsHasAProbability)
{
    Lights lights = lights_around(6'000);
    for (const double s : {1e-8, 1e-4, 0.1})
        for (const double share : {1.0, 1e-3, 1e-6})
            lights.push_back([&] {
                const double c = share * s - s;
                const Vec3<double> along = normalized(cross(n, Vec3<double>(1, 0, 0)));
                return make_light_of_power(x + 5.0 * (along * std::sqrt(1 - c * c) + n * c), 5 * s,
                                           Vec3<double>(1));
            }());
    const auto expect_drawn = [&]<class T>(T) {
        for (const Surface& s : surfaces()) {
            const auto found = table_of<TreePolicy, T>(lights, s.view);
            const auto exact = table_of<ProductPolicy, T>(lights, s.view);
            int drawn = 0;
            for (std::size_t j = 0; j < lights.size(); ++j) {
                if (!(exact.probability(j) > 0)) continue;
                EXPECT_GT(found.probability(j), 0) << s.what << " " << j;
                ++drawn;
            }
            EXPECT_GT(drawn, 2'500);
        }
    };
    expect_drawn(0.0);
    expect_drawn(0.F);
    expect_drawn(TestLanes<float>(0.F));
}

/// From far away all lights of a part are drawn by power, and that is hardly worse.
TEST(TreePolicy, FarAwayLightsOfAPartAreDrawnByPower)
{
    Lights lights = lights_around(20'000);
    for (Light& light : lights) light.center += 150.0 * n;
    const auto table = table_of<TreePolicy, TestLanes<float>>(lights, {});
    const auto exact = table_of<ProductPolicy, TestLanes<float>>(lights, {});
    EXPECT_LT(excess(exact.probabilities(), table.probabilities()), 0.05);
    std::map<int, int> ratios;  // P over the power: a few different ones, not one per light
    for (std::size_t j = 0; j < lights.size(); ++j) {
        const double power = luminance_radius(lights[j]) * lights[j].radius;
        if (power > 0)
            ++ratios[static_cast<int>(std::lround(std::log(table.probability(j) / power) * 1e5))];
    }
    EXPECT_LT(ratios.size(), 400);
}

/// A power of two is no rounding: to the last bit.
TEST(TreePolicy, OfManyLightsDoesNotDependOnUnits)
{
    const Lights lights = lights_around(6'000);
    const Surface s("ggx", 0, 0.3);
    const std::vector<double> usual = table_of<TreePolicy>(lights, s.view).probabilities();
    for (const double scale : {0x1p-30, 0x1p30}) {
        Lights others = lights;
        for (Light& l : others)
            l.center *= scale, l.radius *= scale, l.radiance_radius *= static_cast<float>(scale);
        const Prepared<TreePolicy> there(others, x * scale, n, x * scale, wo, s.view);
        EXPECT_EQ(there.probabilities(), usual) << scale;
    }
}

TEST(TreePolicy, TakesAtMost64BytesPerLight)
{
    for (const int count : {1'000, 4'097, 70'000}) {
        const TreePolicy policy(lights_around(count));
        EXPECT_LE(policy.tree().bytes(), static_cast<std::size_t>(64 * count)) << count;
        EXPECT_GE(policy.tree().bytes(), static_cast<std::size_t>(40 * count)) << count;
    }
}

/// All at one place, so that no cut parts them. Groups that are not opened are guessed.
TEST(TreePolicy, LightsAtOnePlaceAreDrawnAlike)
{
    const Lights lights(1'000, make_light({0, 3, 0}, 0.1, Vec3<double>(1)));
    const auto table = table_of<TreePolicy>(lights, {});
    for (std::size_t j = 0; j < lights.size(); ++j)
        ASSERT_NEAR(table.probability(j), 1e-3, 2e-6) << j;
}

/// A sun amid many lamps: its group reaches to the sky, and its lamps are lamps all the same.
TEST(TreePolicy, ASunAmidLampsIsDrawnAboutAsProductDrawsIt)
{
    Lights lights = lights_around(6'000);
    lights.push_back(make_light(n * 1.5e11, 7e8, Vec3<double>(10)));
    const auto check = [&]<class T>(T) {
        const auto found = table_of<TreePolicy, T>(lights, {});
        const auto exact = table_of<ProductPolicy, T>(lights, {});
        EXPECT_GT(exact.probability(6'000), 1e-7);
        EXPECT_NEAR(found.probability(6'000) / exact.probability(6'000), 1, 0.5);
        EXPECT_LT(excess(exact.probabilities(), found.probabilities()), 0.15);
    };
    check(0.0);
    check(TestLanes<float>(0.F));
}

/// It asks whether it is to stop at each split and each part.
TEST(LightTree, TakesStepsInProportionToItsLightsWhereTheyStandOneBehindTheOther)
{
    const auto steps_for = [](int count) {
        Lights lights;
        for (int k = 1; k <= count; ++k)
            lights.push_back(make_light({0, 0, 2.0 * k}, k, Vec3<double>(k == 1 ? 1.0 : 1000.0)));
        int asks = 0;
        const std::function<bool()> asked = [&] { return ++asks < 0; };
        const LightTree tree(lights, StopToken(&asked));
        return asks;
    };
    EXPECT_GT(steps_for(1000), 50);
    EXPECT_LT(steps_for(16000), 17 * steps_for(1000));
}

TEST(LightTree, EndsItsBuildingOnceItIsToldTo)
{
    Lights lights;
    for (int k = 1; k <= 1000; ++k)
        lights.push_back(make_light({0, 0, 2.0 * k}, k, Vec3<double>(1)));
    int asks = 0;
    const std::function<bool()> soon = [&] { return ++asks > 20; };
    EXPECT_THROW(LightTree(lights, StopToken(&soon)), Stopped);
    EXPECT_EQ(asks, 21);
}

}  // namespace
}  // namespace mis
