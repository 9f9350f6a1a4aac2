#include "mis/engine/gbuffer.h"

#include "mis/trace/analytic.h"

#include "tests/engine/bench.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace mis {
namespace {

Scene floor_and_lamp()
{
    Scene scene;
    scene.camera = Camera{.position = {0, 1, 5}, .target = {0, 1, 0}, .resolution = {70, 50}};
    scene.materials = {grey_floor(), {.type = "ggx", .specular = Vec3<double>(0.9), .alpha = 0.2}};
    scene.surfaces = {{Quad{{-4, 0, -4}, {Vec3<double>{0, 0, 8}, Vec3<double>{8, 0, 0}}}, 0},
                      {SphereSurface{{-1, 0.5, 0}, 0.5}, 1}};
    scene.lights = {make_light({0.5, 1.5, 0}, 0.3, Vec3<double>(5)),
                    make_light({1, 0, 0}, 0.4, Vec3<double>(1))};
    return scene;
}

struct Shading {
    Scene scene = floor_and_lamp();
    AnalyticTracer tracer{scene};
    LightHierarchy lights{scene.lights};
    GBuffer rows(int first, int count) const
    {
        return find_shading_points(scene, lights, &tracer, first, count,
                                   any_executor(SerialExecutor{}));
    }
};

/// Dark only where it is certain: a light that touches the tangent plane may still be seen.
TEST(GBuffer, AProbeThatFacesNoLightIsDark)
{
    Light light = three_lights_apart().front();
    light.center = {2, 0, 0.1};
    for (const double height : {-3.0, -1.5, -1.0001, -1.0, -0.9999, 0.0, 2.0}) {
        light.center.y = height * light.radius;
        const Scene scene = probe_under({light}, grey_floor());
        const LitScene lit(scene, nullptr, called_for(scene));
        const GBuffer probes =
            probe_points(scene, lit.lights(), nullptr, any_executor(SerialExecutor{}));
        EXPECT_EQ(probes.dark.size(), height < -1.00005 ? 1U : 0U) << height;
    }
}

/// A view between two places that lie closer than a square root can see.
TEST(GBuffer, ACameraAtATinyDistanceFromItsTargetLooksThere)
{
    Scene scene = floor_and_lamp();
    scene.surfaces = {{Quad{{-4, -1, -4}, {Vec3<double>{0, 0, 8}, Vec3<double>{8, 0, 0}}}, 0}};
    scene.camera->position = {0, 1e-200, 0};
    scene.camera->target = {0, 0, 0};
    scene.camera->up = {1, 0, 0};
    const AnalyticTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    const GBuffer found =
        find_shading_points(scene, lit.lights(), &tracer, 0, scene.camera->resolution[1],
                            any_executor(SerialExecutor{}));
    EXPECT_EQ(found.points.size() + found.dark.size(), 70U * 50U);
    for (const ShadingPoint& p : found.points) EXPECT_EQ(p.x.y, -1);
}

TEST(GBuffer, EveryPixelIsAPointOrDarkOrBackgroundOnce)
{
    const Shading shading;
    const GBuffer buffer = shading.rows(0, 50);
    std::multiset<std::uint32_t> ids(buffer.dark.begin(), buffer.dark.end());
    for (const ShadingPoint& p : buffer.points) ids.insert(p.id);
    for (const Background& b : buffer.background) ids.insert(b.pixel);
    ASSERT_EQ(ids.size(), 70U * 50U);
    for (std::uint32_t id = 0; id < 70 * 50; ++id) EXPECT_EQ(ids.count(id), 1U) << id;
    EXPECT_TRUE(std::any_of(buffer.background.begin(), buffer.background.end(),
                            [](const auto& b) { return b.light == 0; }));
    EXPECT_TRUE(std::any_of(buffer.background.begin(), buffer.background.end(),
                            [](const auto& b) { return b.light < 0; }));
}

TEST(GBuffer, TilesAreNeighboursOfOneMaterialAndCoverAllPoints)
{
    const Shading shading;
    const GBuffer buffer = shading.rows(0, 50);
    std::uint32_t next = 0;
    std::set<int> materials;
    for (const Tile& tile : buffer.tiles) {
        EXPECT_EQ(tile.first, next);
        EXPECT_GT(tile.count, 0U);
        EXPECT_LE(tile.count, 256U);
        next += tile.count, materials.insert(tile.material);
        for (std::uint32_t p = tile.first; p < tile.first + tile.count; ++p) {
            const Vec3<double> x = buffer.points[p].x;
            EXPECT_NEAR(tile.material == 0 ? x.y : length(x - Vec3<double>{-1, 0.5, 0}) - 0.5, 0,
                        1e-12);
        }
    }
    EXPECT_EQ(next, buffer.points.size());
    EXPECT_EQ(materials, (std::set<int>{0, 1}));
}

TEST(GBuffer, PointsFaceTheViewerAndLieOutsideTheLights)
{
    const Shading shading;
    for (const ShadingPoint& p : shading.rows(0, 50).points) {
        EXPECT_GT(dot(p.n, p.wo), 0);
        EXPECT_NEAR(static_cast<double>(length(p.n)), 1, 1e-6);
        EXPECT_NEAR(static_cast<double>(length(p.wo)), 1, 1e-6);
        EXPECT_FALSE(shading.lights.contains(p.x));
        EXPECT_NEAR(length(normalized(Vec3<double>{0, 1, 5} - p.x) - vec_cast<double>(p.wo)), 0,
                    1e-6);
    }
}

TEST(GBuffer, ABandHoldsTheSamePointsAsTheWholePicture)
{
    const Shading shading;
    const GBuffer whole = shading.rows(0, 50), band = shading.rows(16, 32);
    std::map<std::uint32_t, Vec3<double>> places;
    for (const ShadingPoint& p : whole.points) places[p.id] = p.x;
    ASSERT_FALSE(band.points.empty());
    for (const ShadingPoint& p : band.points) EXPECT_EQ(places.at(p.id), p.x);
}

Scene three_probes()
{
    Scene scene = probe_under({make_light({0, 2, 0}, 0.5, Vec3<double>(1))}, grey_floor());
    const Vec3<double> up{0, 1, 0};
    scene.probes = {
        {{0, 0, 0}, up, normalized(Vec3<double>{1, -0.1, 0}), 0},  // seen from below its surface
        {{0, 1.8, 0}, up, up, 0},                                  // inside the light
        {{0, 1.5, 0}, up, up, 0},                                  // on it
        {{3, 0, 0}, up, up, 0}};
    return scene;
}

TEST(Probes, InsideALightOrOnItOrSeenFromBelowAreDark)
{
    const TestScene test(three_probes());
    EXPECT_EQ(test.probes.dark, (std::vector<std::uint32_t>{0, 1, 2}));
    ASSERT_EQ(test.probes.points.size(), 1U);
    EXPECT_EQ(test.probes.points[0].id, 3U);
    EXPECT_EQ(test.probes.points[0].n, (Vec3<float>{0, 1, 0}));
}

TEST(Probes, AreNumberedAfterAllPixels)
{
    Scene scene = three_probes();
    scene.camera = Camera{.resolution = {8, 4}};
    EXPECT_EQ(TestScene(scene).probes.points[0].id, 32U + 3U);
}

}  // namespace
}  // namespace mis
