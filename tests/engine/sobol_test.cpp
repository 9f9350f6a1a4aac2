#include "mis/sampling/sobol.h"
#include "mis/engine/light_order.h"
#include "mis/engine/replay.h"

#include "tests/engine/bench.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace mis {
namespace {

/// What any part of the work recomputes: the sampler's source, point, sample and draw say it all.
/// draws_every_light: seven draws for every light, of which draw 9 is the third of light 1.
template <class T> void expect_numbers_of_the_sequence(const Kernels<T>& kernels, bool every_light)
{
    constexpr std::uint64_t seed = 0x1234'5678'9abc, n = 12, first = (std::uint64_t{5} << 32) + 7;
    std::array<ShadingPoint, 3> points{};
    for (std::size_t p = 0; p < 3; ++p) points[p].id = static_cast<std::uint32_t>(40 + 7 * p);
    const TileJob<T> job{.points = points,
                         .numbers = {seed, n},
                         .draws_every_light = every_light,
                         .draws_per_light = 7,
                         .bsdf_draws = 4};
    const auto batch = std::make_unique<Batch<T>>();
    batch->rows = 77;
    for (std::size_t i = 0; i < 77; ++i) {
        const std::size_t slot = 76 - i;  // as after a compaction, rows are not slots
        batch->slot[i] = static_cast<std::int32_t>(slot);
        batch->point[i] = static_cast<std::int32_t>(i / 30);
        batch->sample_number[slot] = first + slot;
    }
    batch->tile_point = {2, 0, 1};
    const auto word = [&](std::size_t i, Dimension dimension, std::size_t key, std::uint64_t draws,
                          std::uint64_t draw, std::uint32_t stream, Block block) {
        const std::uint64_t sample = first + 76 - i;
        const SequencePoint at{sample / n, sample % n * draws + draw};
        const Words keys =
            scrambling_keys(seed, points[batch->tile_point[i / 30]].id, at, stream, block);
        return sobol_word(dimension, static_cast<std::uint32_t>(at.index), keys[key]);
    };
    batch->draw = every_light ? 9 : 2;
    kernels.sobol_light_numbers(job, *batch);
    for (std::size_t i = 0; i < 77; ++i) {
        const auto light_word = [&](Dimension dimension, std::size_t key) {
            return word(i, dimension, key, 7, 2, every_light ? 1 : 0, Block::light);
        };
        ASSERT_EQ(batch->bits[i] >> 32, light_word(Dimension::choice, key_of::choice));
        ASSERT_EQ(batch->u[i], unit_number<T>(light_word(Dimension::light_u, key_of::light_u)));
        ASSERT_EQ(batch->v[i], unit_number<T>(light_word(Dimension::light_v, key_of::light_v)));
        const Counter counter{points[batch->tile_point[i / 30]].id, first + 76 - i, batch->draw};
        ASSERT_EQ(batch->bits[i] & 0xFFFF'FFFFu, random_words(seed, counter, Block::light)[1]);
    }
    batch->draw = 3;
    kernels.sobol_bsdf_numbers(job, *batch);
    for (std::size_t i = 0; i < 77; ++i) {
        const auto bsdf_word = [&](Dimension dimension, std::size_t key) {
            return word(i, dimension, key, 4, 3, 0, Block::bsdf);
        };
        ASSERT_EQ(batch->lobe[i], unit_number<T>(bsdf_word(Dimension::lobe, key_of::lobe)));
        ASSERT_EQ(batch->u[i], unit_number<T>(bsdf_word(Dimension::bsdf_u, key_of::bsdf_u)));
        ASSERT_EQ(batch->v[i], unit_number<T>(bsdf_word(Dimension::bsdf_v, key_of::bsdf_v)));
    }
}

TEST(SobolNumbers, AreTheSameInEveryInstructionSet)
{
    for (const std::string_view set : instruction_sets()) {
        SCOPED_TRACE(set);
        for (const bool every_light : {false, true}) {
            expect_numbers_of_the_sequence(kernels_of<float>(set), every_light);
            expect_numbers_of_the_sequence(kernels_of<double>(set), every_light);
        }
    }
}

/// `scramblings` observations, each the mean of n samples of the first probe.
template <class T>
PointResult scrambled(const TestScene& test, const Strategy& strategy, int n, int scramblings)
{
    const ReadyStrategy<T> ready(test.lit, strategy, kernels<T>(),
                                 {1, static_cast<std::uint64_t>(n)});
    const Tile& tile = test.probes.tiles.at(0);
    Workspace<T> workspace;
    PointResult result;
    workspace.run(ready.job(tile, test.probes.points), ready.pipeline(tile.material),
                  {.chunk = scramblings, .chunks = 1, .samples_per_observation = n},
                  std::span(&result, 1), {}, {});
    return result;
}

/// Lights one before another, black ones, some below the horizon; in the order of the list they
/// jump about.
Scene crowded()
{
    Material plate{.type = "blinn"};
    plate.diffuse = Vec3<double>(0.3), plate.specular = Vec3<double>(0.5), plate.exponent = 20;
    Lights lights = thirty_lights_one_dark();
    const Lights more = eclipse();
    lights.insert(lights.begin() + 5, more.begin(), more.end());
    return probe_under(lights, plate);
}

/// Independent samples and scrambled sequences have the same mean: every technique, model and kind
/// of policy, with more than one draw too.
TEST(SobolNumbers, ChangeNoMean)
{
    constexpr double false_alarm = 1e-4;  // for all strategies together
    const TestScene test(crowded());
    const auto strategies = {"uniform/light",
                             "power/balance",
                             "solid-angle/power/union",
                             "irradiance/light",
                             "irradiance/balance/one-sample",
                             "radiant-solid-angle/maximum@3+2",
                             "power/cutoff/union/one-sample",
                             "all/light",
                             "all/power@3+2",
                             "brdf",
                             "cosine",
                             "hemisphere"};
    const double bound = z_bound(false_alarm, static_cast<int>(strategies.size()));
    for (const char* name : strategies) {
        const Strategy s = parse_strategy(name);
        const Moments a = run_probe<float>(test, s, kernels<float>(), scaled(64'000))
                              .result.luminance,
                      b = scrambled<float>(test, s, 16, scaled(4000)).luminance;
        const double se = std::hypot(a.mean_se(), b.mean_se());
        EXPECT_LE(std::fabs(a.mean - b.mean), bound * se + 4e-6 * a.mean) << name;
    }
}

/// And it is what quadrature says of it, where one light overhead is all there is: π r² L cos β/d²
/// times the albedo over π.
TEST(SobolNumbers, HaveTheExactMean)
{
    const Lights lights = three_lights_apart();
    const TestScene test(probe_under(lights, grey_floor()));
    double exact = 0;
    for (const Light& light : lights)
        exact +=
            luminance(irradiance(light, Vec3<double>(0), {0, 1, 0})) * 0.5 * std::numbers::inv_pi;
    for (const char* name :
         {"uniform/light", "power/power", "all/light", "irradiance/balance@3+1"}) {
        const Moments m = scrambled<double>(test, parse_strategy(name), 64, scaled(1000)).luminance;
        EXPECT_LE(std::fabs(m.mean - exact), z_bound(1e-4, 4) * m.mean_se()) << name;
        EXPECT_LT(m.mean_se(), 0.002 * exact) << name;
    }
}

/// Where one light stands overhead of a grey floor, samples are smooth functions of u alone: the
/// variance of a mean of 64 is far below a 64th.
TEST(SobolNumbers, GainWhereSamplesAreSmooth)
{
    Lights one = three_lights_apart();
    one.resize(1);
    const TestScene test(probe_under(one, grey_floor()));
    const Strategy s = parse_strategy("uniform/light");
    const double independent =
        run_probe<float>(test, s, kernels<float>(), scaled(100'000)).result.luminance.variance();
    double last = 1;
    for (const int n : {4, 16, 64}) {
        const double gain =
            independent / (n * scrambled<float>(test, s, n, 500).luminance.variance());
        EXPECT_GT(gain, 2 * last) << n;
        last = gain;
    }
}

/// One sample at a time is no sequence yet: the same variance as of independent ones.
TEST(SobolNumbers, OfOneSampleGainNothing)
{
    const TestScene test(crowded());
    for (const char* name : {"power/power", "irradiance/light", "all/light", "brdf"}) {
        const Moments
            a = run_probe<float>(test, parse_strategy(name), kernels<float>(), scaled(100'000))
                    .result.luminance,
            b = scrambled<float>(test, parse_strategy(name), 1, scaled(100'000)).luminance;
        const double se = std::hypot(a.variance_se(), b.variance_se());
        EXPECT_LE(std::fabs(a.variance() - b.variance()), z_bound(1e-4, 4) * se) << name;
    }
}

/// An observation is the mean of its samples, wherever batches of 256 cut them.
TEST(Observations, AreTheMeansOfTheirSamples)
{
    const TestScene test(crowded());
    const Strategy s = parse_strategy("power/power");
    const ReadyStrategy<float> ready(test.lit, s, kernels<float>(), {1, 300});
    const Tile& tile = test.probes.tiles.at(0);
    Workspace<float> workspace;
    const auto run = [&](const SampleRange& range, std::span<ChunkTotals> totals) {
        PointResult result;
        workspace.run(ready.job(tile, test.probes.points), ready.pipeline(0), range,
                      std::span(&result, 1), {}, totals);
        return result;
    };
    std::vector<ChunkTotals> chunks(2);
    const PointResult all = run({.chunk = 3, .chunks = 2, .samples_per_observation = 300}, chunks);
    ASSERT_EQ(all.luminance.count, 6U);
    Moments means;
    for (std::uint64_t k = 0; k < 6; ++k) {
        const PointResult one = run({.first = 300 * k, .chunk = 300, .chunks = 1}, {});
        means.add(one.luminance.mean);
        if (k % 3 == 2) {
            EXPECT_NEAR(chunks[k / 3].mean, means.mean, 1e-12) << k;
            EXPECT_NEAR(chunks[k / 3].variance, means.variance(), 1e-9 * means.variance());
            means = {};
        }
    }
    EXPECT_NEAR(luminance(all.mean()), all.luminance.mean, 1e-6);
}

/// Replay computes one sample alone; its value is what the run had at that number.
TEST(SobolNumbers, AreReplayedOneByOne)
{
    const TestScene test(crowded());
    for (const char* name : {"irradiance/power", "power/balance/union@3+2", "all/power",
                             "uniform/balance/one-sample"}) {
        const ReadyStrategy<float> ready(test.lit, parse_strategy(name), kernels<float>(), {1, 16});
        const Tile& tile = test.probes.tiles.at(0);
        Workspace<float> workspace;
        PointResult result;
        workspace.run(ready.job(tile, test.probes.points), ready.pipeline(0),
                      {.first = 32, .chunk = 16}, std::span(&result, 1), {}, {});
        Vec3<double> sum(0);
        for (std::uint64_t k = 32; k < 48; ++k)
            sum += replay(test.lit, ready, tile, test.probes.points[0], k).value;
        EXPECT_EQ(sum, result.radiance_sum) << name;
    }
}

TEST(LightOrder, IsAPermutationWhoseNeighboursAreNear)
{
    Lights lights;
    for (int j = 0; j < 1000; ++j)  // in the list, far from each other
        lights.push_back(make_light({(j * 389) % 1000 / 100.0, 5, (j * 117) % 1000 / 100.0}, 0.01,
                                    Vec3<double>(1)));
    lights.push_back(make_light({1.5e11, 0, 0}, 7e8, Vec3<double>(1)));
    const LightOrder order = spatial_order(lights);
    const auto step = [&](const auto& at) {
        double sum = 0;
        for (std::size_t k = 1; k < lights.size(); ++k) {
            const Vec3<double> d = lights[at(k)].center - lights[at(k - 1)].center;
            sum += std::min(10.0, std::sqrt(length2(d)));
        }
        return sum / static_cast<double>(lights.size());
    };
    for (std::size_t k = 0; k < lights.size(); ++k)
        ASSERT_EQ(order.place_of[static_cast<std::size_t>(order.light_at[k])],
                  static_cast<LightIndex>(k));
    const double of_list = step([](std::size_t k) { return k; }),
                 of_order = step(
                     [&](std::size_t k) { return static_cast<std::size_t>(order.light_at[k]); });
    EXPECT_GT(of_list, 3);
    EXPECT_LT(of_order, 1);
    EXPECT_EQ(order.light_at.back(), 1000);
}

/// The order of the tables changes no light's number and no probability.
TEST(LightOrder, ChangesNoProbability)
{
    const Scene scene = crowded();
    const TestScene test(scene);
    for (const char* policy : {"uniform", "power", "solid-angle", "irradiance"}) {
        const Strategy s = parse_strategy(std::string(policy) + "/light");
        const ReadyStrategy<double> independent(test.lit, s, kernels<double>(), 1),
            sobol(test.lit, s, kernels<double>(), {1, 16});
        std::vector<double> probability(scene.lights.size(), -1);
        std::set<LightIndex> drawn;
        const auto note = [&](const ReadyStrategy<double>& ready, std::uint64_t k) {
            const Replay found =
                replay(test.lit, ready, test.probes.tiles[0], test.probes.points[0], k);
            const auto choice =
                std::find_if(found.steps.begin(), found.steps.end(),
                             [](const auto& step) { return step.stage == StageKind::choose; });
            double& p = probability[static_cast<std::size_t>(choice->light)];
            if (p < 0) p = choice->probability;
            EXPECT_NEAR(p, choice->probability, 1e-12) << policy << " " << choice->light;
            drawn.insert(choice->light);
        };
        for (std::uint64_t k = 0; k < 500; ++k) note(independent, k), note(sobol, k);
        EXPECT_GT(drawn.size(), 2U);
    }
}

}  // namespace
}  // namespace mis
