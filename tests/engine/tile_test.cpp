// A tile's run: the same bits however the work is cut and spread, and what it counts.
#include "mis/engine/tile.h"

#include "mis/run/tbb.h"
#include "mis/trace/analytic.h"

#include "tests/engine/bench.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <thread>

namespace mis {
namespace {

/// A camera above a floor with a ball on it, two materials, three lights.
Scene room()
{
    Scene scene;
    scene.camera = Camera{.position = {0, 2, 6}, .target = {0, 0.5, 0}, .resolution = {56, 40}};
    scene.materials = {grey_floor(),
                       {.type = "blinn",
                        .diffuse = Vec3<double>(0.1),
                        .specular = {0.6, 0.5, 0.4},
                        .exponent = 80}};
    scene.surfaces = {{Quad{{-9, 0, -9}, {Vec3<double>{0, 0, 18}, Vec3<double>{18, 0, 0}}}, 0},
                      {SphereSurface{{0.5, 0.7, 0.3}, 0.7}, 1}};
    scene.lights = three_lights_apart();
    return scene;
}

template <class T> bool same_bits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// As many threads as it is told, however few processors there are; the last body first.
struct Threads {
    int count;
    int threads() const { return count; }
    void for_each(std::size_t n, const std::function<void(std::size_t)>& body) const
    {
        std::atomic<std::size_t> left{n};
        std::vector<std::thread> all;
        for (int t = 0; t < count; ++t)
            all.emplace_back([&] {
                while (true) {
                    const std::size_t taken = left.fetch_sub(1);
                    if (taken == 0 || taken > n) return;
                    body(taken - 1);
                }
            });
        for (std::thread& thread : all) thread.join();
    }
};

struct LitPoints {
    std::vector<PointResult> results;
    std::vector<ChunkTotals> totals;  ///< tile by tile
};

/// All of a scene's camera points by one strategy, its tiles spread by an executor.
template <class T>
LitPoints light_all(const TestScene& test, const char* name, const AnyExecutor& executor)
{
    constexpr SampleRange range{.chunk = 10, .chunks = 3};
    const GBuffer shading = find_shading_points(test.scene, test.lit.lights(), test.lit.surfaces(),
                                                0, test.scene.camera->resolution[1], executor);
    const ReadyStrategy<T> ready(test.lit, parse_strategy(name), kernels<T>(), 1);
    LitPoints run{std::vector<PointResult>(shading.points.size()),
                  std::vector<ChunkTotals>(shading.tiles.size() * 3)};
    WorkspacePool<T> workspaces;
    executor.for_each(shading.tiles.size(), [&](std::size_t t) {
        const Tile& tile = shading.tiles[t];
        workspaces.with([&](Workspace<T>& workspace) {
            workspace.run(
                ready.job(tile, std::span(shading.points).subspan(tile.first, tile.count)),
                ready.pipeline(tile.material), range,
                std::span(run.results).subspan(tile.first, tile.count), {},
                std::span(run.totals).subspan(3 * t, 3));
        });
    });
    return run;
}

const std::vector<const char*> some_strategies{"radiant-solid-angle/power",
                                               "power/balance/union",
                                               "all/light",
                                               "uniform/maximum/one-sample",
                                               "brdf",
                                               "solid-angle/balance@3+2"};

TEST(Tiles, GiveTheSameBitsOn1And2And3Threads)
{
    const Scene scene = room();
    const AnalyticTracer tracer(scene);
    const TestScene test(scene, &tracer);
    for (const char* name : some_strategies) {
        const LitPoints usual = light_all<float>(test, name, any_executor(SerialExecutor{}));
        ASSERT_GT(usual.results.size(), 1000U);
        for (const AnyExecutor& executor :
             {any_executor(TbbExecutor(2)), any_executor(Threads{3})}) {
            const LitPoints run = light_all<float>(test, name, executor);
            EXPECT_TRUE(same_bits(run.results, usual.results))
                << name << " on " << executor.threads << " threads";
            EXPECT_TRUE(same_bits(run.totals, usual.totals))
                << name << " on " << executor.threads << " threads";
        }
    }
}

/// The same bits of every sample, whichever batch it falls in; the merged moments differ by the
/// order of their sums.
template <class T> void expect_no_trace_of_the_cuts(const char* name)
{
    const Scene scene = room();
    const AnalyticTracer tracer(scene);
    const TestScene test(scene, &tracer);
    const GBuffer shading = find_shading_points(test.scene, test.lit.lights(), &tracer, 0, 16,
                                                any_executor(SerialExecutor{}));
    const ReadyStrategy<T> ready(test.lit, parse_strategy(name), kernels<T>(), 1);
    const Tile& tile =
        *std::max_element(shading.tiles.begin(), shading.tiles.end(),
                          [](const Tile& a, const Tile& b) { return a.count < b.count; });
    const auto points = std::span(shading.points).subspan(tile.first, tile.count);
    Workspace<T> workspace;
    const auto run = [&](std::size_t step, std::initializer_list<SampleRange> ranges) {
        std::vector<PointResult> results(points.size());
        for (const SampleRange& range : ranges)
            for (std::size_t first = 0; first < points.size(); first += step) {
                const std::size_t count = std::min(step, points.size() - first);
                workspace.run(ready.job(tile, points.subspan(first, count)),
                              ready.pipeline(tile.material), range,
                              std::span(results).subspan(first, count), {}, {});
            }
        return results;
    };
    const auto whole = run(points.size(), {{.chunk = 7, .chunks = 5}});
    for (const auto& cut :
         {run(1, {{.chunk = 7, .chunks = 5}}), run(37, {{.chunk = 35, .chunks = 1}}),
          run(points.size(),
              {{.first = 0, .chunk = 7, .chunks = 2}, {.first = 14, .chunk = 7, .chunks = 3}})})
        for (std::size_t p = 0; p < points.size(); ++p) {
            const Moments &a = whole[p].luminance, &b = cut[p].luminance;
            ASSERT_EQ(cut[p].radiance_sum, whole[p].radiance_sum) << name << ", point " << p;
            ASSERT_EQ(a.count, b.count);
            ASSERT_NEAR(a.mean, b.mean, 1e-12 * a.mean);
            ASSERT_NEAR(a.m2, b.m2, 1e-9 * a.m2 + 1e-20);
        }
}

TEST(Tiles, MayBeCutAnywhereInPointsAndSamples)
{
    for (const char* name : some_strategies) {
        expect_no_trace_of_the_cuts<float>(name);
        expect_no_trace_of_the_cuts<double>(name);
    }
}

TEST(Tiles, ChunksAddUpToTheWhole)
{
    const TestScene test(probe_under(three_lights_apart(), grey_floor()));
    const ReadyStrategy<float> ready(test.lit, parse_strategy("power/light"), kernels<float>(), 1);
    const std::vector<double> weights{0.25};
    std::vector<ChunkTotals> totals(4);
    PointResult all;
    Workspace<float> workspace;
    const auto job = ready.job(test.probes.tiles[0], test.probes.points);
    const TileTotals cost = workspace.run(job, ready.pipeline(0), {.chunk = 300, .chunks = 4},
                                          std::span(&all, 1), weights, totals);
    EXPECT_EQ(cost.samples, 1200U);
    EXPECT_EQ(all.luminance.count, 1200U);
    double mean = 0;
    for (std::size_t c = 0; c < 4; ++c) {
        PointResult one;
        workspace.run(job, ready.pipeline(0), {.first = 300 * c, .chunk = 300, .chunks = 1},
                      std::span(&one, 1), {}, {});
        EXPECT_NEAR(totals[c].mean, one.luminance.mean, 1e-12);
        EXPECT_NEAR(totals[c].variance, one.luminance.variance(), 1e-9 * totals[c].variance);
        EXPECT_EQ(totals[c].relative_variance, totals[c].variance * 0.25);
        mean += totals[c].mean / 4;
    }
    EXPECT_NEAR(all.luminance.mean, mean, 1e-12);
    EXPECT_NEAR(luminance(all.mean()), all.luminance.mean, 1e-6);
}

/// A table of more lights than the scratch was made for; and many points that share it.
TEST(Tiles, HoldATableOfAnyNumberOfLights)
{
    Scene scene = probe_under({}, grey_floor());
    for (int j = 0; j < 40'000; ++j)
        scene.lights.push_back(
            make_light({j % 200 - 100.0, 50, j / 200 - 100.0}, 0.2, Vec3<double>(1)));
    const TestScene test(scene);
    const Strategy s = parse_strategy("solid-angle/light");
    const Outcome outcome = run_probe<float>(test, s, kernels<float>(), 5000);
    double exact = 0;
    for (const Light& light : scene.lights)
        exact += luminance(irradiance(light, {0, 0, 0}, {0, 1, 0})) * 0.5 / std::numbers::pi;
    EXPECT_NEAR(outcome.result.luminance.mean, exact, 6 * outcome.result.luminance.mean_se());

    const ReadyStrategy<float> ready(test.lit, s, kernels<float>(), 1);
    std::vector<ShadingPoint> points(20, test.probes.points[0]);
    for (std::size_t p = 0; p < points.size(); ++p) points[p].id = static_cast<std::uint32_t>(p);
    std::vector<PointResult> together(points.size()), apart(points.size());
    Workspace<float> workspace;
    workspace.run(ready.job(test.probes.tiles[0], points), ready.pipeline(0),
                  {.chunk = 9, .chunks = 1}, together, {}, {});
    for (std::size_t p = 0; p < points.size(); ++p)
        workspace.run(ready.job(test.probes.tiles[0], std::span(points).subspan(p, 1)),
                      ready.pipeline(0), {.chunk = 9, .chunks = 1}, std::span(apart).subspan(p, 1),
                      {}, {});
    EXPECT_TRUE(same_bits(together, apart));
}

}  // namespace
}  // namespace mis
