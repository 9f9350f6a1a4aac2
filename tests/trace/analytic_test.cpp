#include "mis/trace/analytic.h"

#include "mis/trace/intersect.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// A floor y = 0, a unit sphere above it, and a triangle to the right.
Scene three_shapes()
{
    Scene scene;
    scene.surfaces.push_back(
        {Quad{{-5, 0, -5}, {Vec3<double>{0, 0, 10}, Vec3<double>{10, 0, 0}}}, 4});
    scene.surfaces.push_back({SphereSurface{{0, 3, 0}, 1}, 5});
    Mesh mesh;
    mesh.positions = {{3, 1, 0}, {4, 1, 0}, {3, 2, 0}};
    mesh.normals = {{0, 0, 1}, {0.6F, 0, 0.8F}, {0, 0.6F, 0.8F}};
    mesh.triangles = {{0, 1, 2}};
    scene.surfaces.push_back({mesh, 6});
    return scene;
}

TEST(AnalyticTracer, MeetsTheNearestSurfaceWithItsNormalTurnedToTheRay)
{
    const Scene scene = three_shapes();
    const AnalyticTracer tracer(scene);
    const auto sphere = tracer.first_hit({0, 9, 0}, {0, -1, 0});
    ASSERT_TRUE(sphere);
    EXPECT_EQ(sphere->material, 5);
    EXPECT_DOUBLE_EQ(sphere->distance, 5);
    EXPECT_NEAR(length(sphere->n - Vec3<double>{0, 1, 0}), 0, 1e-15);
    const auto floor_from_below = tracer.first_hit({3, -2, 3}, {0, 1, 0});
    ASSERT_TRUE(floor_from_below);
    EXPECT_EQ(floor_from_below->material, 4);
    EXPECT_EQ(floor_from_below->n, (Vec3<double>{0, -1, 0}));
    const auto inside_of_sphere = tracer.first_hit({0, 3, 0}, {1, 0, 0});
    ASSERT_TRUE(inside_of_sphere);
    EXPECT_DOUBLE_EQ(inside_of_sphere->distance, 1);
    EXPECT_EQ(inside_of_sphere->n, (Vec3<double>{-1, 0, 0}));
    EXPECT_FALSE(tracer.first_hit({0, 9, 0}, {0, 1, 0}));
}

TEST(AnalyticTracer, SmoothNormalsAreInterpolatedAndUnit)
{
    const Scene scene = three_shapes();
    const auto hit = AnalyticTracer(scene).first_hit({3.25, 1.25, 5}, {0, 0, -1});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->material, 6);
    EXPECT_EQ(hit->geometric, (Vec3<double>{0, 0, 1}));
    const Vec3<double> expected = normalized(Vec3<double>{0.15, 0.15, 0.9});
    EXPECT_NEAR(length(hit->n - expected), 0, 1e-7);
}

/// A normal that leans beyond the outline: its triangle is seen from the front, itself from behind.
TEST(AnalyticTracer, AShadingNormalIsTurnedToTheRayWhicheverSideOfTheSurfaceThatIs)
{
    Scene scene = three_shapes();
    std::get<Mesh>(scene.surfaces[2].shape).normals.assign(3, {0.8F, 0, 0.6F});
    const AnalyticTracer tracer(scene);
    const Vec3<double> direction = normalized(Vec3<double>{4, 0, -1}), on{3.25, 1.25, 0};
    for (const double side : {1.0, -1.0}) {  // the triangle's front and back
        const Vec3<double> along{direction.x, 0, side * direction.z};
        const auto hit = tracer.first_hit(on - along * 0.2, along);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->geometric, (Vec3<double>{0, 0, side}));
        EXPECT_NEAR(length(hit->n + Vec3<double>{0.8, 0, 0.6}), 0, 1e-7);
        EXPECT_EQ(hit->is_n_behind(), side > 0);
    }
}

TEST(AnalyticTracer, HidesStrictlyBeforeTheDistance)
{
    const Scene scene = three_shapes();
    const AnalyticTracer tracer(scene);
    const std::vector<ShadowRay> rays{
        {{0, 9, 0}, {0, -1, 0}, 5.01F},
        {{0, 9, 0}, {0, -1, 0}, 4.99F},
        {{0, 9, 0}, {0, -1, 0}, 5.F},
        {{0, 9, 0}, {0, 1, 0}, std::numeric_limits<float>::infinity()}};
    std::vector<std::uint8_t> hidden(rays.size(), 7);
    tracer.occluded(rays, hidden);
    EXPECT_EQ(hidden, (std::vector<std::uint8_t>{1, 0, 0, 0}));
}

/// Both roots keep their digits: far away, and from just above the surface.
TEST(HitSphere, KeepsItsDigitsFarAwayAndCloseBy)
{
    EXPECT_NEAR(hit_sphere({0, 0, 0}, {0, 0, 1}, {0, 0, 1e8}, 1), 1e8 - 1, 1e-7);
    EXPECT_NEAR(hit_sphere({0, 0, 1 + 1e-9}, {0, 0, -1}, {0, 0, 0}, 1) * 1e9, 1, 1e-6);
    EXPECT_EQ(hit_sphere({0, 0, 1 + 1e-9}, {0, 0, 1}, {0, 0, 0}, 1), no_hit);
    EXPECT_EQ(hit_sphere({0, 0, 1}, {1, 0, 0}, {0, 0, 0}, 1), no_hit);  // 0 is not divided by 0
}

/// A ray that starts at x plus its offset misses the surface that x lies on, whichever way it
/// leaves.
TEST(SurfaceOffset, OfAPointOnASurfaceMovesARayOffIt)
{
    const Scene scene = three_shapes();
    const AnalyticTracer tracer(scene);
    for (const Vec3<double>& target :
         {Vec3<double>{1, 0, 2}, Vec3<double>{0, 3, 0}, Vec3<double>{3.2, 1.3, 0}}) {
        const Vec3<double> eye{2, 8, 6};
        const auto hit = tracer.first_hit(eye, normalized(target - eye));
        ASSERT_TRUE(hit);
        EXPECT_GT(hit->offset, 0);
        EXPECT_LT(hit->offset, 1e-4);
        EXPECT_NEAR(tracer.offset_at(hit->x), hit->offset, hit->offset);
        const Vec3<float> origin =
            vec_cast<float>(hit->x + hit->geometric * hit->offset - tracer.origin());
        const Vec3<double> across = normalized(cross(hit->geometric, Vec3<double>{0.3, 0.4, 0.5}));
        const Vec3<float> grazing = vec_cast<float>(normalized(across + hit->geometric * 1e-6));
        const std::vector<ShadowRay> rays{{origin, vec_cast<float>(hit->geometric), 0.1F},
                                          {origin, grazing, 0.1F}};
        std::vector<std::uint8_t> hidden(2);
        tracer.occluded(rays, hidden);
        EXPECT_EQ(hidden, (std::vector<std::uint8_t>{0, 0}));
    }
}

}  // namespace
}  // namespace mis
