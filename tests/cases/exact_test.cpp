// The closed form of whole tiles: against quadrature, against samples, and where it is refused.
#include "mis/engine/exact.h"

#include "mis/predict/predict.h"
#include "mis/trace/embree.h"

#include "tests/engine/bench.h"
#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// Lights apart from one another, above the horizon, cut by it and below it.
Scene side_by_side(Uniforms& uniforms)
{
    Lights lights;
    for (int j = 0; j < 5; ++j)
        lights.push_back(make_light({3.0 * (j - 2), uniforms.between(-0.4, 2), 3}, 0.5,
                                    {uniforms(), uniforms(), uniforms()}));
    return probe_under(lights, grey_floor());
}

/// The probe of a scene, planned.
struct Planned {
    explicit Planned(const Scene& scene) : tracer(scene), test(scene, &tracer)
    {
        test.lit.plan(test.probes, any_executor(SerialExecutor{}));
    }
    const Tile& tile() const { return test.probes.tiles.at(0); }
    bool has_form() const { return has_closed_form(test.lit, tile()); }

    EmbreeTracer tracer;
    TestScene test;
};

TEST(Exact, IsTheQuadratureAtRandomPoints)
{
    Uniforms uniforms(91);
    int cut = 0;
    for (int k = 0; k < scaled(60); ++k) {
        const Scene scene = side_by_side(uniforms);
        const Planned planned(scene);
        ASSERT_TRUE(planned.has_form());
        for (const Light& light : scene.lights)
            cut += std::abs(light.center.y) < light.radius ? 1 : 0;
        const Strategy strategy = parse_strategy("all/light");
        const Predicted expected = predict(scene, scene.probes[0], std::span(&strategy, 1))[0];
        const double found = luminance(
            exact_radiance(planned.test.lit, planned.tile(), planned.test.probes.points[0]));
        EXPECT_NEAR(found, expected.mean, 1e-7 * found + 4 * expected.mean_error) << k;
    }
    EXPECT_GT(cut, scaled(30));
}

TEST(Exact, OfAWholeSphereAboveTheHorizonIsItsIrradianceTimesAlbedoOverPi)
{
    for (const double radius : {1e-20, 1e-6, 0.5, 1.9}) {
        const Light light = make_light_of_power({1, 2, 0}, radius, {1, 2, 3});
        const Planned planned(probe_under({light}, grey_floor()));
        ASSERT_TRUE(planned.has_form());
        const Vec3<double> expected =
            irradiance(light, Vec3<double>(0), {0, 1, 0}) * (0.5 / pi<double>);
        const Vec3<double> found =
            exact_radiance(planned.test.lit, planned.tile(), planned.test.probes.points[0]);
        EXPECT_LE(length(found - expected), 1e-12 * length(expected)) << radius;
    }
}

TEST(Exact, IsRefusedWhereAnythingStandsBetweenOrShines)
{
    Uniforms uniforms(92);
    Scene scene = side_by_side(uniforms);
    EXPECT_TRUE(Planned(scene).has_form());
    Scene hidden = scene, shadowed = scene, glossy = scene;
    const Vec3<double> between = 0.5 * scene.lights[2].center;
    hidden.lights.push_back(make_light(between, 0.1, Vec3<double>(1)));
    shadowed.surfaces.push_back({SphereSurface{between, 0.1}, 0});
    glossy.materials[0].type = "blinn", glossy.materials[0].exponent = 9;
    glossy.materials[0].specular = Vec3<double>(0.5);
    EXPECT_FALSE(Planned(hidden).has_form());
    EXPECT_FALSE(Planned(shadowed).has_form());
    EXPECT_FALSE(Planned(glossy).has_form());
}

/// More lights than are asked one by one: their lists say it.
TEST(Exact, IsProvedOfManyLightsByTheirLists)
{
    Lights lights;
    for (int j = 0; j < 100; ++j)
        lights.push_back(
            make_light({0.5 * (j % 10) - 2.5, 3, 0.5 * (j / 10) - 2.5}, 0.05, Vec3<double>(1)));
    EXPECT_TRUE(Planned(probe_under(lights, grey_floor())).has_form());
    lights.push_back(make_light(0.7 * lights[50].center, 0.05, Vec3<double>(1)));
    EXPECT_FALSE(Planned(probe_under(lights, grey_floor())).has_form());
}

TEST(Exact, CountsDarkPointsAsExact)
{
    const Planned planned(probe_under({make_light({0, 2, 0}, 0.5, Vec3<double>(1))}, grey_floor()));
    GBuffer shading = planned.test.probes;
    shading.dark = {7, 8, 9};
    const ExactShare share = exact_share(planned.test.lit, shading);
    EXPECT_EQ(share.exact, 4U);
    EXPECT_EQ(share.points, 4U);
    shading.tiles[0].plan = {};
    EXPECT_EQ(exact_share(planned.test.lit, shading).exact, 3U);
}

}  // namespace
}  // namespace mis
