// Points of a host, lit in one call: the picture that mis renders, point by point.
#include "mis/engine/light_points.h"

#include "mis/engine/render.h"
#include "mis/run/serial.h"
#include "mis/trace/analytic.h"

#include "tests/engine/bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

namespace mis {
namespace {

/// Two materials under thirty lights, and a ball before some of them, 40 × 24 pixels.
Scene ball_on_a_floor()
{
    Material glossy;
    glossy.type = "blinn", glossy.diffuse = Vec3<double>(0.2);
    glossy.specular = {0.5, 0.4, 0.3}, glossy.exponent = 30;
    Scene scene = probe_under(thirty_lights_one_dark(), grey_floor());
    scene.materials.push_back(glossy);
    scene.surfaces.push_back({Quad{{-4, 0, -4}, {Vec3<double>(0, 0, 8), {8, 0, 0}}}, 0});
    scene.surfaces.push_back({SphereSurface{{0.3, 0.5, 0.2}, 0.4}, 1});
    scene.camera = Camera{{0, 1.5, 3}, {0, 0.3, 0}, {0, 1, 0}, 40, {40, 24}};
    return scene;
}

/// A host's arrays, and room for what comes out.
struct Columns {
    std::array<std::vector<double>, 3> x, ray_origin;
    std::array<std::vector<float>, 3> n, wo, radiance;
    std::vector<std::int32_t> material;
    std::vector<std::uint32_t> id;

    void add(const ShadingPoint& point, int material_here, const Vec3<double>& frame)
    {
        for (int c = 0; c < 3; ++c) {
            const auto i = static_cast<std::size_t>(c);
            x[i].push_back(point.x[c]);
            ray_origin[i].push_back(static_cast<double>(point.ray_origin[c]) + frame[c]);
            n[i].push_back(point.n[c]), wo[i].push_back(point.wo[c]);
            radiance[i].push_back(std::numeric_limits<float>::quiet_NaN());
        }
        material.push_back(material_here), id.push_back(point.id);
    }
    PointArrays points() const
    {
        return {{x[0], x[1], x[2]},
                {n[0], n[1], n[2]},
                {wo[0], wo[1], wo[2]},
                {ray_origin[0], ray_origin[1], ray_origin[2]},
                material,
                id};
    }
    RadianceArrays out() { return {radiance[0], radiance[1], radiance[2]}; }
};

/// A scene whose rays a host traces, by a callback.
struct Hosted {
    Scene scene = ball_on_a_floor();
    AnalyticTracer behind{scene};
    mutable std::size_t rays = 0, packets = 0;
    HostTracer tracer{[this](std::span<const ShadowRay> some, std::span<std::uint8_t> hidden) {
                          rays += some.size(), ++packets;
                          behind.occluded(some, hidden);
                      },
                      behind.origin()};
    LitScene lit{scene, &tracer, all_effects(scene)};
    GBuffer buffer =
        find_shading_points(scene, lit.lights(), &behind, 0, 24, any_executor(SerialExecutor{}));

    /// Its points, each with its material, mixed up.
    Columns mixed() const
    {
        std::vector<std::pair<std::uint32_t, int>> all;
        for (const Tile& tile : buffer.tiles)
            for (std::uint32_t p = tile.first; p < tile.first + tile.count; ++p)
                all.emplace_back(p, tile.material);
        std::ranges::sort(all, {}, [](const auto& one) { return one.first * 2654435761U; });
        Columns columns;
        for (const auto& [p, material] : all)
            columns.add(buffer.points[p], material, behind.origin());
        return columns;
    }
};

/// What mis makes of the same points by itself, by id.
std::vector<Vec3<double>> rendered(const Hosted& host, const ReadyStrategy<float>& strategy,
                                   int samples)
{
    Band band{host.buffer, std::vector<PointResult>(host.buffer.points.size())};
    WorkspacePool<float> workspaces;
    light_band(strategy, band, 0, samples, workspaces, any_executor(SerialExecutor{}));
    std::vector<Vec3<double>> by_id(40 * 24, Vec3<double>(0));
    for (std::size_t p = 0; p < band.results.size(); ++p)
        by_id[band.shading.points[p].id] = band.results[p].mean();
    return by_id;
}

/// A picture that was stopped says how many samples each of its points has, at least.
TEST(LightBand, StoppedLeavesPointsWithFewerSamplesWhichAreCounted)
{
    const Hosted host;
    const ReadyStrategy<float> strategy(host.lit, parse_strategy("power/power"), kernels<float>(),
                                        1);
    const AnyExecutor serial = any_executor(SerialExecutor{});
    WorkspacePool<float> workspaces;
    Band band{host.buffer, std::vector<PointResult>(host.buffer.points.size())};
    ASSERT_GT(band.shading.tiles.size(), 3U);
    int asks = 0;
    const std::function<bool()> asked = [&] { return ++asks > 2; };  // of more tiles
    light_band(strategy, band, 0, 8, workspaces, serial, StopToken(&asked));
    EXPECT_EQ(least_samples(band), 0U);
    light_band(strategy, band, 8, 8, workspaces, serial);
    EXPECT_EQ(least_samples(band), 8U);
}

TEST(LightPoints, GivesWhatMisRenders)
{
    const Hosted host;
    for (const char* name : {"power/power", "irradiance/balance", "brdf", "uniform/light/union"}) {
        const ReadyStrategy<float> strategy(host.lit, parse_strategy(name), kernels<float>(), 1);
        Columns columns = host.mixed();
        PointLighter lighter(host.lit, strategy);
        const TileTotals totals = lighter.light(columns.points(), 0, 64, columns.out());
        EXPECT_EQ(totals.samples, 64 * columns.id.size());
        EXPECT_EQ(totals.invalid, 0u);
        const std::vector<Vec3<double>> expected = rendered(host, strategy, 64);
        // The same samples, rounded from another origin: a few meet an edge on its other side.
        std::size_t off = 0;
        for (std::size_t i = 0; i < columns.id.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c) {
                const double e = expected[columns.id[i]][static_cast<int>(c)];
                const double found = static_cast<double>(columns.radiance[c][i]);
                if (!(std::abs(found - e) <= 1e-4 * e)) ++off;
            }
        EXPECT_LE(off, columns.id.size() / 200) << name;
    }
}

TEST(LightPoints, AsksTheHostForItsRaysInPackets)
{
    const Hosted host;
    const ReadyStrategy<float> strategy(host.lit, parse_strategy("power/light"), kernels<float>(),
                                        1);
    Columns columns = host.mixed();
    PointLighter lighter(host.lit, strategy);
    host.rays = host.packets = 0;
    const TileTotals totals = lighter.light(columns.points(), 0, 64, columns.out());
    EXPECT_EQ(host.rays, totals.shadow_rays);
    EXPECT_GT(host.rays, 8 * columns.id.size());
    EXPECT_GT(host.rays, 32 * host.packets);
}

TEST(LightPoints, WhatCannotBeLitIsBlack)
{
    const Hosted host;
    const ReadyStrategy<float> strategy(host.lit, parse_strategy("power/power"), kernels<float>(),
                                        1);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Columns columns = host.mixed();
    columns.x[1][3] = nan;                       // not finite
    for (auto& wo : columns.wo) wo[5] = -wo[5];  // seen from below
    const Light& light = host.scene.lights[1];
    for (int c = 0; c < 3; ++c) columns.x[static_cast<std::size_t>(c)][7] = light.center[c];
    PointLighter lighter(host.lit, strategy);
    EXPECT_EQ(lighter.light(columns.points(), 0, 16, columns.out()).invalid, 16u);
    for (const std::size_t dark : {3u, 5u, 7u})
        for (const auto& channel : columns.radiance) EXPECT_EQ(channel[dark], 0) << dark;
    for (const auto& channel : columns.radiance) EXPECT_GT(channel[4], 0);
    EXPECT_EQ(lighter.light({}, 0, 16, {}).samples, 0u);  // no points at all
}

TEST(LightPointsDeathTest, AMaterialThatThereIsNotIsNamedOrCounted)
{
    const Hosted host;
    const ReadyStrategy<float> strategy(host.lit, parse_strategy("power/power"), kernels<float>(),
                                        1);
    for (const std::int32_t lie : {-1, 99}) {
        Columns columns = host.mixed();
        columns.material[2] = lie;
        PointLighter lighter(host.lit, strategy);
        TileTotals totals;
        totals.invalid = 16;
        EXPECT_DEBUG_DEATH(totals = lighter.light(columns.points(), 0, 16, columns.out()),
                           "points.material");
        EXPECT_EQ(totals.invalid, 16u);
#ifdef NDEBUG
        for (const auto& channel : columns.radiance) EXPECT_EQ(channel[2], 0);
#endif
    }
}

TEST(LightPoints, AreLitByStrataOfTheirOwn)
{
    const Hosted host;
    const ReadyStrategy<float> strategy(host.lit, strata(64), kernels<float>(), 1);
    Columns columns = host.mixed();
    PointLighter lighter(host.lit, strategy);
    const TileTotals totals = lighter.light(columns.points(), 0, 256, columns.out());
    EXPECT_EQ(totals.samples, 256 * columns.id.size());
    const ReadyStrategy<float> plain(host.lit, parse_strategy("product/power"), kernels<float>(),
                                     2);
    const std::vector<Vec3<double>> expected = rendered(host, plain, 4096);
    double sum = 0, expected_sum = 0;  // of some 900 points: both are known to a thousandth
    for (std::size_t i = 0; i < columns.id.size(); ++i) {
        sum += static_cast<double>(columns.radiance[0][i]);
        expected_sum += expected[columns.id[i]].x;
    }
    EXPECT_NEAR(sum, expected_sum, 0.01 * expected_sum);
}

TEST(LightPoints, RefuseStrataOfTooManyLights)
{
    const Lights many(1025, make_light({0, 3, 0}, 0.1, Vec3<double>(1)));
    const TestScene test(probe_under(many, grey_floor()));
    EXPECT_THROW(ReadyStrategy<float>(test.lit, strata(64), kernels<float>(), 1), StrategyError);
}

}  // namespace
}  // namespace mis
