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
    for (int j = 0; j < 5; ++j) {
        const Vec3<double> radiance{uniforms(), uniforms(), uniforms()};
        lights.push_back(make_light({3.0 * (j - 2), uniforms.between(-0.4, 2), 3}, 0.5, radiance));
    }
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

/// Variance over the squared mean, of double samples at the probe: as many as it takes to see the
/// least variance that any strategy has.
double relative_variance(const Planned& planned, const Strategy& strategy)
{
    const Moments found =
        run_probe<double>(planned.test, strategy, kernels<double>(), 2000).result.luminance;
    return found.variance() / (found.mean * found.mean);
}

/// Strategies of which a theorem says that every sample is the closed form are those that have no
/// variance, and no others; but for `tree`, which is `product` where there are few lights, and for
/// heuristics that drop the BSDF's draw where it is less dense throughout.
void expect_exact_strategies_are_those_without_variance(const Scene& scene)
{
    const Planned planned(scene);
    ASSERT_TRUE(planned.has_form());
    const AnyExecutor serial = any_executor(SerialExecutor{});
    EXPECT_TRUE(has_closed_form(planned.test.lit, planned.test.probes, 1, serial));
    std::vector<Strategy> strategies = every_strategy();
    strategies.push_back(strata(1));
    strategies.push_back(strata(64));
    for (const Strategy& strategy : strategies) {
        if (strategy.policy == "tree" || strategy.heuristic == "cutoff" ||
            strategy.heuristic == "maximum")
            continue;
        const double variance = relative_variance(planned, strategy);
        if (gives_closed_form(scene, strategy)) {
            EXPECT_LE(variance, 1e-11) << name_of(strategy);  // areas are known to 3e-6
        } else {
            EXPECT_GT(variance, 1e-10) << name_of(strategy);
        }
    }
}

TEST(Exact, StrategiesAreThoseWithoutVarianceUnderLightsOfOneColour)
{
    Uniforms uniforms(93);
    Scene scene = side_by_side(uniforms);
    for (Light& light : scene.lights)
        light = make_light(light.center, light.radius, Vec3<double>{1, 0.5, 2} * (1 + uniforms()));
    scene.materials[0].diffuse = {0.9, 0.2, 0.1};
    EXPECT_TRUE(gives_closed_form(scene, parse_strategy("product/light/projected@3+0")));
    expect_exact_strategies_are_those_without_variance(scene);
}

TEST(Exact, StrategiesAreThoseWithoutVarianceUnderLightsOfManyColours)
{
    Uniforms uniforms(94);
    Scene scene = side_by_side(uniforms);
    EXPECT_TRUE(gives_closed_form(scene, parse_strategy("irradiance/light/projected")));
    expect_exact_strategies_are_those_without_variance(scene);  // on a grey floor
    scene.materials[0].diffuse = {0.9, 0.2, 0.1};
    EXPECT_FALSE(gives_closed_form(scene, parse_strategy("irradiance/light/projected")));
    expect_exact_strategies_are_those_without_variance(scene);
}

TEST(Exact, StrategiesAreThoseWithoutVarianceUnderOneLight)
{
    const Scene scene =
        probe_under({make_light({0.5, 0.1, 2}, 0.7, Vec3<double>{1, 2, 3})}, grey_floor());
    EXPECT_TRUE(gives_closed_form(scene, parse_strategy("uniform/light/projected")));
    expect_exact_strategies_are_those_without_variance(scene);
}

/// Where few samples are to come, a tile's plan leaves out proofs that do not pay; whether a
/// strategy is exact is asked all the same.
TEST(Exact, IsProvedHoweverFewSamplesAreToCome)
{
    Uniforms uniforms(95);
    Scene scene = side_by_side(uniforms);
    for (int k = 0; k < 40; ++k)
        scene.surfaces.push_back({SphereSurface{{0.5 * k - 10, -3, 0}, 0.1}, 0});
    const EmbreeTracer tracer(scene);
    TestScene test(scene, &tracer);
    test.lit.expect_samples(4);
    const AnyExecutor serial = any_executor(SerialExecutor{});
    test.lit.plan(test.probes, serial);
    EXPECT_FALSE(has_closed_form(test.lit, test.probes.tiles.at(0)));
    EXPECT_TRUE(has_closed_form(test.lit, test.probes, 1, serial));
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
