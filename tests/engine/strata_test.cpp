// `strata`: how a round's draws are spread, whatever was seen before, and what its observations
// are.
#include "mis/engine/strata_tile.h"

#include "tests/engine/bench.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace mis {
namespace {

/// What was seen of a point's lights before: so many draws of each, and how many saw it.
enum class History { none, all_seen, none_seen, heavy_hidden, by_chance };
constexpr std::array histories{History::none, History::all_seen, History::none_seen,
                               History::heavy_hidden, History::by_chance};

template <class T> struct Known {
    static constexpr std::size_t lights = 37, places = 48;
    std::vector<T> share, drawn, seen, block;

    /// Shares from 1 down to 1e-4 of each other, one of them 0.
    explicit Known(History history)
        : share(places), drawn(places), seen(places), block(places, T(0.5))
    {
        T sum = 0;
        for (std::size_t j = 0; j < lights; ++j)
            sum += share[j] = j == 5 ? T(0) : std::pow(T(10), -T(j * 7 % lights) / 9);
        for (std::size_t j = 0; j < lights; ++j) {
            share[j] /= sum;
            if (history == History::none) continue;
            const auto bits = random_bits(7, j);
            drawn[j] = static_cast<T>(bits % 40);
            const bool is_seen = history == History::all_seen ||
                                 (history == History::heavy_hidden && share[j] < T(0.02));
            if (history == History::by_chance)
                seen[j] = static_cast<T>(bits / 64 % (bits % 40 + 1));
            else if (is_seen) seen[j] = drawn[j];
            if (history != History::by_chance) block[j] = is_seen ? T(1) : T(1e-6);
        }
    }
    StrataKnowledge<T> at() { return {share, {drawn, seen}, block}; }
};

/// One round's spread at offsets (a, b).
template <class T>
void spread_at(StrataSpread<T>& spread, Known<T>& known, int draws, double a, double b)
{
    StrataParts<T>& parts = spread.room(Known<T>::places, draws);
    kernels<T>().strata.part_lights(known.at(), draws, parts);
    spread.spread(draws, {a, b});
}

/// Over all offsets, every light that counts must be drawn as often as its draws are worth: then
/// the estimate has the right mean, whatever was seen before. Offsets are equally spaced, so what
/// is drawn of a light is exact to one draw in as many as there are offsets.
template <class T> void expect_unbiased(History history, int draws)
{
    SCOPED_TRACE(static_cast<int>(history) * 1000 + draws);
    Known<T> known(history);
    StrataSpread<T> spread;
    constexpr int offsets = 4096;
    std::vector<double> drawn(Known<T>::places);
    std::vector<T> expected(Known<T>::places), first(Known<T>::places);
    for (int k = 0; k < offsets; ++k) {
        spread_at(spread, known, draws, (k * 1657 % offsets + 0.5) / offsets, (k + 0.5) / offsets);
        ASSERT_EQ(spread.draws().size(), static_cast<std::size_t>(draws));
        spread.write_expected(expected);
        if (k == 0) first = expected;
        std::vector<double> of_heavy(Known<T>::places);
        for (const StratumDraw<T>& draw : spread.draws()) {
            const auto j = static_cast<std::size_t>(draw.place);
            ASSERT_EQ(draw.expected, expected[j]);
            if (draw.stratum == rest_stratum) drawn[j] += 1;
            else of_heavy[j] += 1 / double(draw.expected), drawn[j] = -1;
        }
        for (const double sum : of_heavy) ASSERT_TRUE(sum == 0 || std::abs(sum - 1) < 1e-6) << sum;
    }
    for (std::size_t j = 0; j < Known<T>::places; ++j) {
        EXPECT_EQ(first[j] > 0, known.share[j] > 0) << j;
        if (drawn[j] < 0) continue;  // heavy
        EXPECT_NEAR(drawn[j] / offsets, double(first[j]), 1.5 / offsets) << j;
    }
}

TEST(Strata, DrawEveryLightAsOftenAsTheySay)
{
    for (const History history : histories)
        for (const int draws : {1, 2, 3, 4, 12, 48, 192}) {
            expect_unbiased<float>(history, draws);
            expect_unbiased<double>(history, draws);
        }
}

TEST(Strata, GiveHalfOfTheDrawsToStrataAtMostAndMoreToWhatIsUnsure)
{
    Known<double> known(History::by_chance);
    StrataSpread<double> spread;
    spread_at(spread, known, 48, 0.5, 0.5);
    std::vector<std::size_t> strata;
    for (const StratumDraw<double>& draw : spread.draws())
        if (draw.stratum != rest_stratum && draw.number == 0) strata.push_back(draw.stratum);
    EXPECT_GT(strata.size(), 3u);
    EXPECT_LE(strata.size(), 24u);
    // A light half of whose draws saw it needs more than one of which all did.
    const std::size_t j = strata.front();
    std::array<double, 2> draws{};
    for (const bool is_unsure : {false, true}) {
        known.drawn[j] = 100, known.seen[j] = is_unsure ? 50 : 100;
        spread_at(spread, known, 48, 0.5, 0.5);
        std::vector<double> expected(Known<double>::places);
        spread.write_expected(expected);
        draws[is_unsure] = expected[j];
    }
    EXPECT_GT(draws[1], draws[0]);
}

TEST(Strata, DrawNothingWhereNothingCounts)
{
    Known<float> known(History::by_chance);
    std::ranges::fill(known.share, 0.0F);
    StrataSpread<float> spread;
    spread_at(spread, known, 16, 0.5, 0.5);
    EXPECT_TRUE(spread.draws().empty());
}

/// Where nothing is hidden and there is no lobe, every draw of a stratum is its light's share.
TEST(Strata, AreExactWhereEveryLightHasOne)
{
    const TestScene test(probe_under(three_lights_apart(), grey_floor()));
    const Outcome outcome = run_probe<double>(test, strata(64), kernels<double>(), 640);
    EXPECT_EQ(outcome.result.luminance.count, 10u);
    const double exact = luminance(direct_radiance(Lambert(test.scene.materials[0]),
                                                   test.scene.lights, test.probes.points.at(0)));
    EXPECT_NEAR(outcome.result.luminance.mean, exact, 1e-9 * exact);
    EXPECT_LT(outcome.result.luminance.variance(), 1e-18 * exact * exact);
}

/// A tile of points side by side, which learn from each other.
struct Floor {
    Scene scene = probe_under(
        eclipse(),
        {.type = "blinn", .diffuse = {0.2, 0.1, 0.1}, .specular = {0.3, 0.5, 0.2}, .exponent = 40});
    Floor()
    {
        scene.camera = Camera{.resolution = {16, 16}};
        const Probe first = scene.probes[0];
        scene.probes.clear();
        for (int i = 0; i < 40; ++i) {
            scene.probes.push_back(first);
            scene.probes.back().position += Vec3<double>{0.02 * (i % 8), 0, 0.02 * (i / 8)};
        }
    }
};

std::vector<PointResult> run_floor(Workspace<float>& workspace, const Floor& floor,
                                   const NumberSource& numbers, const SampleRange& range)
{
    const LitScene lit(floor.scene, nullptr, called_for(floor.scene));
    GBuffer probes =
        probe_points(floor.scene, lit.lights(), nullptr, any_executor(SerialExecutor{}));
    const ReadyStrategy<float> ready(lit, strata(range.samples_per_observation), kernels<float>(),
                                     numbers);
    const Tile tile{0, static_cast<std::uint32_t>(probes.points.size()), 0,
                    probes.points.front().x};
    std::vector<PointResult> results(probes.points.size());
    workspace.run(ready.job(tile, probes.points), ready.pipeline(0), range, results, {}, {});
    return results;
}

void expect_same_bits(const std::vector<PointResult>& a, const std::vector<PointResult>& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t p = 0; p < a.size(); ++p) {
        EXPECT_EQ(a[p].luminance.mean, b[p].luminance.mean) << p;
        EXPECT_EQ(a[p].luminance.m2, b[p].luminance.m2) << p;
    }
}

TEST(Strata, DoNotDependOnWhatTheirRoomHeldBefore)
{
    const Floor floor;
    const SampleRange range{.chunk = 3, .samples_per_observation = 64};
    Workspace<float> fresh, used;
    run_floor(used, floor, 99, {.chunk = 1, .samples_per_observation = 200});
    expect_same_bits(run_floor(fresh, floor, 5, range), run_floor(used, floor, 5, range));
}

/// Batches are lent to one strategy after the other.
TEST(Strata, LeaveTheirRoomToOthersAsTheyWouldFindItNew)
{
    Floor floor;
    floor.scene.materials[0] = grey_floor();
    Workspace<float> fresh, used;
    run_floor(used, floor, 99, {.chunk = 1, .samples_per_observation = 100});
    const auto run_product = [&](Workspace<float>& workspace) {
        const LitScene lit(floor.scene, nullptr, called_for(floor.scene));
        const GBuffer probes =
            probe_points(floor.scene, lit.lights(), nullptr, any_executor(SerialExecutor{}));
        const ReadyStrategy<float> ready(lit, parse_strategy("product/light"), kernels<float>(), 5);
        const Tile tile{0, static_cast<std::uint32_t>(probes.points.size()), 0,
                        probes.points.front().x};
        std::vector<PointResult> results(probes.points.size());
        workspace.run(ready.job(tile, probes.points), ready.pipeline(0), {.chunk = 7}, results, {},
                      {});
        return results;
    };
    expect_same_bits(run_product(fresh), run_product(used));
}

TEST(Strata, HaveObservationsThatGoByTheirNumberAlone)
{
    const Floor floor;
    Workspace<float> workspace;
    const auto three = run_floor(workspace, floor, 5, {.chunk = 3, .samples_per_observation = 64});
    std::vector<PointResult> one_by_one(three.size());
    for (std::uint64_t o = 0; o < 3; ++o) {
        const auto one = run_floor(workspace, floor, 5,
                                   {.first = 64 * o, .chunk = 1, .samples_per_observation = 64});
        for (std::size_t p = 0; p < one.size(); ++p)
            one_by_one[p].luminance.merge(one[p].luminance);
    }
    expect_same_bits(three, one_by_one);
}

double mean_variance(const std::vector<PointResult>& results)
{
    double sum = 0;
    for (const PointResult& r : results) sum += r.luminance.variance();
    return sum / static_cast<double>(results.size());
}

/// On average over many observations and points: the sequences must help, or they are not used.
TEST(Strata, HaveFarLessVarianceBySequences)
{
    const Floor floor;
    Workspace<float> workspace;
    NumberSource independent(5);
    independent.is_asked_for = true;
    const SampleRange range{.chunk = 40, .samples_per_observation = 64};
    EXPECT_LT(mean_variance(run_floor(workspace, floor, 5, range)),
              0.6 * mean_variance(run_floor(workspace, floor, independent, range)));
}

TEST(Strata, DrawTheLobeBySequencesToo)
{
    const Floor floor;
    const LitScene lit(floor.scene, nullptr, called_for(floor.scene));
    NumberSource independent(5);
    const auto stage_of = [&] {
        const ReadyStrategy<float> ready(lit, strata(16), kernels<float>(), independent);
        return ready.pipeline(0).bsdf.at(1).run;
    };
    EXPECT_EQ(stage_of(), kernels<float>().sobol_bsdf_numbers);
    independent.is_asked_for = true;
    EXPECT_EQ(stage_of(), kernels<float>().bsdf_numbers);
}

}  // namespace
}  // namespace mis
