#include "mis/study/maps.h"

#include "mis/run/serial.h"
#include "mis/trace/analytic.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace mis {
namespace {

/// A floor under three lights, seen with sky above it, and a board that turns its back on them.
Scene floor_and_sky()
{
    Scene scene = probe_under(three_lights_apart(), grey_floor());
    scene.camera = Camera{.position = {0, 1, 6}, .target = {0, 1, 0}, .resolution = {40, 24}};
    scene.surfaces.push_back({Quad{{-5, 0, -5}, {Vec3<double>{0, 0, 10}, {10, 0, 0}}}, 0});
    scene.surfaces.push_back({Quad{{1, 0.2, 4}, {Vec3<double>{0.8, 0, 0}, {0, 0.8, 0}}}, 0});
    return scene;
}

class MapsOfAFloor : public testing::Test {
protected:
    MapsOfAFloor()
    {
        for (const char* name : {"uniform/light", "solid-angle/power", "solid-angle/light"})
            strategies.push_back(parse_strategy(name));
        study = run_study(lit, strategies, {.spp = 256}, executor);
        maps = maps_of(lit, study, 16, executor);
    }

    Scene scene = floor_and_sky();
    AnalyticTracer tracer{scene};
    LitScene lit{scene, &tracer, called_for(scene)};
    AnyExecutor executor = any_executor(SerialExecutor{});
    std::vector<Strategy> strategies;
    Study study;
    Maps maps;
};

TEST_F(MapsOfAFloor, HaveTheMeansAndVariancesOfTheReport)
{
    ASSERT_EQ(maps.strategies.size(), 3U);
    const double points = static_cast<double>(study.report.shading_points);
    for (const StrategyMap& map : maps.strategies) {
        double mean = 0, variance = 0;
        for (std::size_t p = 0; p < maps.kind.size(); ++p) {
            if (maps.kind[p] == PixelKind::background) continue;
            mean += luminance(vec_cast<double>(map.mean[p]));
            variance += static_cast<double>(map.variance[p]);
        }
        const StrategyReport& report = study.report.strategies[map.strategy];
        EXPECT_NEAR(mean / points, report.mean, 1e-5 * report.mean);
        EXPECT_NEAR(variance / points, report.variance.value, 1e-5 * report.variance.value);
        EXPECT_TRUE(map.bad.empty());
    }
}

TEST_F(MapsOfAFloor, TellSurfacesFromWhatLiesBehindThem)
{
    const auto count = [&](PixelKind kind) {
        return static_cast<std::size_t>(std::count(maps.kind.begin(), maps.kind.end(), kind));
    };
    EXPECT_GT(count(PixelKind::background), 100U);
    EXPECT_GT(count(PixelKind::dark), 5U);
    EXPECT_EQ(count(PixelKind::background), study.report.background_pixels);
    EXPECT_EQ(count(PixelKind::lit) + count(PixelKind::dark), study.report.shading_points);
}

TEST_F(MapsOfAFloor, WinnersLeadInTheirSquareAndTheirSharesAddUp)
{
    EXPECT_EQ(maps.policies, (std::vector<std::string>{"uniform", "solid-angle"}));
    EXPECT_EQ(maps.winner_square, 4);
    for (const WinnerMap* map : {&maps.by_variance, &maps.by_efficiency}) {
        std::vector<std::size_t> pixels(3);
        std::size_t lit_pixels = 0;
        for (std::size_t p = 0; p < maps.kind.size(); ++p) {
            EXPECT_TRUE(maps.kind[p] == PixelKind::lit || map->strategy[p] == -1);
            lit_pixels += maps.kind[p] == PixelKind::lit;
            if (map->strategy[p] >= 0) ++pixels[static_cast<std::size_t>(map->strategy[p])];
        }
        for (std::size_t s = 0; s < 3; ++s)
            EXPECT_NEAR(map->strategy_wins[s], double(pixels[s]) / double(lit_pixels), 1e-12);
    }
    // A light by its solid angle is far better at some place of a floor under three lamps.
    EXPECT_GT(maps.by_variance.policy_wins[1], 0.2);
}

TEST_F(MapsOfAFloor, ListTheLightsThatGiveMost)
{
    ASSERT_EQ(maps.lights.stride, 1);
    for (std::size_t p = 0; p < maps.kind.size(); ++p) {
        const auto& lights = maps.lights.lights[p];
        if (maps.kind[p] != PixelKind::lit) continue;
        const double sum =
            std::accumulate(lights.begin(), lights.end(), 0.0,
                            [](double s, const LightShare& l) { return s + double(l.share); });
        EXPECT_NEAR(sum, 1, 1e-6);  // there are but three
        for (std::size_t k = 1; k < lights.size(); ++k)
            EXPECT_LE(lights[k].share, lights[k - 1].share);
    }
}

}  // namespace
}  // namespace mis
