#include "mis/engine/gbuffer.h"

#include "mis/engine/exact.h"
#include "mis/trace/analytic.h"

#include "tests/engine/bench.h"

#include <gtest/gtest.h>

#include <map>
#include <numbers>
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

/// A floor z = 0 whose smooth normals lie nearly flat, seen at a slant from where they lean away
/// from, under one light.
struct LeaningNormals {
    explicit LeaningNormals(const Vec3<double>& lamp)
    {
        Mesh mesh;
        mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
        mesh.normals.assign(4, vec_cast<float>(n));
        mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
        scene.camera = Camera{.position = {-4, 0, 1},
                              .target = {0, 0, 0},
                              .up = {0, 0, 1},
                              .vertical_fov_degrees = 20,
                              .resolution = {32, 32}};
        scene.materials = {grey_floor()};
        scene.surfaces = {{mesh, 0}};
        scene.lights = {make_light(lamp, 0.5, Vec3<double>(40))};
        const LitScene lit(scene, nullptr, called_for(scene));
        const AnalyticTracer tracer(scene);
        found = find_shading_points(scene, lit.lights(), &tracer, 0, 32,
                                    any_executor(SerialExecutor{}));
    }
    Vec3<double> n = normalized(Vec3<double>{1, 0, 0.1});
    Scene scene;
    GBuffer found;
};

TEST(GBuffer, ANormalThatLeansAwayIsTurnedToTheViewerAndCounted)
{
    const LeaningNormals lit({-3, 0, 3});  // n leans away from it; the turned one faces it
    EXPECT_EQ(lit.found.points.size(), 352U);
    EXPECT_EQ(lit.found.counts.turned_normals, 352U);
    EXPECT_EQ(lit.found.counts.turned_and_dark, 0U);
    EXPECT_TRUE(lit.found.dark.empty());
    for (const ShadingPoint& p : lit.found.points) {
        EXPECT_GT(dot(p.n, p.wo), 0);
        EXPECT_NEAR(length(vec_cast<double>(p.n) + lit.n), 0, 1e-6);
        EXPECT_GT(p.ray_origin.z, 0);  // on the side that is seen
    }
    const LeaningNormals dark({3, 0, 3});  // above the floor, and behind the turned normal
    EXPECT_EQ(dark.found.counts.turned_normals, 352U);
    EXPECT_EQ(dark.found.counts.facing_no_light, 352U);
    EXPECT_EQ(dark.found.counts.seen_from_below, 0U);
    EXPECT_EQ(dark.found.counts.turned_and_dark, 352U);
    EXPECT_EQ(dark.found.dark.size(), 352U);
}

/// What a turned normal faces is lit by the closed form with that normal, as far as the light
/// stands before the surface.
TEST(GBuffer, ATurnedNormalIsLitByWhatItFaces)
{
    const LeaningNormals at({-3, 0, 3});
    const LitScene lit(at.scene, nullptr, called_for(at.scene));
    ASSERT_FALSE(at.found.points.empty());
    for (const ShadingPoint& p : at.found.points) {
        const Vec3<double> expected =
            irradiance(at.scene.lights[0], p.x, -at.n) * (0.5 / std::numbers::pi);
        const Vec3<double> got = exact_radiance(lit, at.found.tiles.front(), p);
        EXPECT_GT(expected.x, 0);
        EXPECT_NEAR(got.x, expected.x, 1e-5 * expected.x);
    }
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
    EXPECT_EQ(test.probes.counts.seen_from_below, 1U);
    EXPECT_EQ(test.probes.counts.inside_light, 2U);
    EXPECT_EQ(test.probes.counts.turned_normals, 0U);
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
