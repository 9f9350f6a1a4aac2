// The mean of every strategy against quadrature, by z-test; and a planted error that the same test
// sees.
#include "mis/bsdf/registry.h"
#include "mis/trace/analytic.h"
#include "mis/trace/embree.h"

#include "tests/engine/bench.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// The chance that any of the tests of this file fails where all is right.
constexpr double false_alarm = 1e-6;
constexpr int tests_at_most = 4000;
constexpr std::uint64_t seed_of_means = 12;

double z_of(const Outcome& outcome, double exact)
{
    // Where all samples are alike, what they differ by from the truth is rounding.
    return (outcome.result.luminance.mean - exact) /
           (outcome.result.luminance.mean_se() + 1e-6 * exact);
}

/// All strategies on one probe. Directions that know nothing of lights seldom meet one: they take
/// more samples.
template <class T> void expect_means(const TestScene& test, double exact, int samples)
{
    const double bound = z_bound(false_alarm, tests_at_most);
    for (const Strategy& s : every_strategy_and_strata()) {
        const Outcome outcome =
            run_probe<T>(test, s, kernels<T>(), scaled(s.chooses_light() ? samples : 4 * samples),
                         seed_of_means);
        EXPECT_LT(std::abs(z_of(outcome, exact)), bound)
            << name_of(s) << ": mean " << outcome.result.luminance.mean << " ± "
            << outcome.result.luminance.mean_se() << ", exact " << exact;
        EXPECT_EQ(outcome.totals.invalid, 0U) << name_of(s);
    }
}

double reference(const TestScene& test)
{
    double exact = 0;
    for_each_type(Bsdfs{}, [&]<class B>() {
        if (B::name == test.scene.materials[0].type)
            exact = luminance(direct_radiance(B(test.scene.materials[0]), test.scene.lights,
                                              test.probes.points.at(0)));
    });
    return exact;
}

Material glossy(std::string_view type)
{
    return {.type = std::string(type),
            .diffuse = {0.2, 0.1, 0.1},
            .specular = {0.3, 0.5, 0.2},
            .exponent = 40,
            .alpha = 0.3};
}

TEST(EveryStrategy, HasTheExactMeanUnderThreeLights)
{
    for (const std::string_view type : {"lambert", "lecture", "blinn", "ggx"}) {
        SCOPED_TRACE(type);
        const TestScene test(probe_under(three_lights_apart(), glossy(type)));
        expect_means<float>(test, reference(test), 25'000);
    }
}

TEST(EveryStrategy, HasTheExactMeanInDouble)
{
    const TestScene test(probe_under(three_lights_apart(), grey_floor()));
    expect_means<double>(test, reference(test), 25'000);
}

/// A lamp before the middle of a larger one: a ring of that is left, all in closed form.
double radiance_of_the_eclipse()
{
    const Lights lights = eclipse();
    const Vec3<double> x(0), n{0, 1, 0};
    Light covered = lights[0];  // the part of the larger that is hidden is a sphere of the same cap
                                // as the smaller
    covered.radius = lights[1].radius / length(lights[1].center) * length(covered.center);
    covered.radiance_radius *= static_cast<float>(covered.radius / lights[0].radius);
    const Vec3<double> e = irradiance(lights[0], x, n) - irradiance(covered, x, n) +
                           irradiance(lights[1], x, n) + irradiance(lights[2], x, n);
    return luminance(e) * 0.5 / std::numbers::pi;
}

TEST(EveryStrategy, HasTheExactMeanUnderAnEclipse)
{
    const TestScene test(probe_under(eclipse(), grey_floor()));
    expect_means<float>(test, radiance_of_the_eclipse(), 50'000);
    expect_means<double>(test, radiance_of_the_eclipse(), 10'000);
}

/// A copy of every light, listed after it, is hidden by it: no mean changes. So is a black light
/// behind another.
TEST(EveryStrategy, HasTheSameMeanWithHiddenCopies)
{
    Lights lights = three_lights_apart();
    const double exact = reference(TestScene(probe_under(lights, grey_floor())));
    const Lights copies = lights;
    lights.insert(lights.end(), copies.begin(), copies.end());
    lights.push_back(make_light(copies[0].center * 2.0, copies[0].radius, Vec3<double>(0)));
    expect_means<float>(TestScene(probe_under(lights, grey_floor())), exact, 25'000);
}

/// A black light hides what is behind it, and a plate that is no light does, too.
/// Glass around each light, just as large, near the origin and far from it.
TEST(EveryStrategy, SeesALightWhoseSurfaceATouchingSphereShares)
{
    for (const double around : {0.0, 1e4}) {
        Scene scene = probe_under(three_lights_apart(), grey_floor());
        scene.probes[0].position += Vec3<double>(around);
        for (Light& light : scene.lights) {
            light.center += Vec3<double>(around);
            scene.surfaces.push_back({SphereSurface{light.center, light.radius}, 0});
        }
        const double exact = reference(TestScene(scene));
        const EmbreeTracer embree(scene);
        const AnalyticTracer analytic(scene);
        for (const SurfaceTracer* tracer :
             std::initializer_list<const SurfaceTracer*>{&embree, &analytic})
            for (const char* name : {"uniform/light", "brdf", "solid-angle/power"}) {
                const Outcome outcome =
                    run_probe<float>(TestScene(scene, tracer), parse_strategy(name),
                                     kernels<float>(), scaled(100'000), seed_of_means);
                EXPECT_LT(std::abs(z_of(outcome, exact)), z_bound(false_alarm, tests_at_most))
                    << name << ", around " << around << ": mean " << outcome.result.luminance.mean
                    << ", exact " << exact;
            }
    }
}

TEST(EveryStrategy, LosesExactlyTheLightThatSomethingDarkHides)
{
    const Lights lights = three_lights_apart(), visible(lights.begin() + 1, lights.end());
    const double exact = reference(TestScene(probe_under(visible, grey_floor())));
    Lights with_black = lights;
    with_black.push_back(make_light(lights[0].center * 0.5, 0.6, Vec3<double>(0)));
    expect_means<float>(TestScene(probe_under(with_black, grey_floor())), exact, 25'000);

    Scene scene = probe_under(lights, grey_floor());
    scene.surfaces = {{Quad{{-0.4, 1, -0.4}, {Vec3<double>{0.8, 0, 0}, Vec3<double>{0, 0, 1}}}, 0}};
    const AnalyticTracer tracer(scene);
    expect_means<float>(TestScene(scene, &tracer), exact, 25'000);
}

TEST(EveryStrategy, Is0AndNeverInvalidUnderBlackLightsAndUnderNone)
{
    Lights black = three_lights_apart();
    for (Light& light : black) light.radiance_radius = Vec3<float>(0);
    for (const Lights& lights : {black, Lights{}}) {
        TestScene test(probe_under(lights, grey_floor()));
        test.sample_the_dark();
        for (const Strategy& s : every_strategy_and_strata()) {
            const Outcome outcome = run_probe<float>(test, s, kernels<float>(), 300);
            EXPECT_EQ(outcome.result.luminance.mean, 0) << name_of(s);
            EXPECT_EQ(outcome.result.luminance.m2, 0) << name_of(s);
            EXPECT_EQ(outcome.totals.invalid, 0U) << name_of(s);
        }
    }
}

TEST(EveryStrategy, Is0UnderLightsBelowTheHorizon)
{
    Lights lights = three_lights_apart();
    for (Light& light : lights) light.center.y = -light.center.y;
    for (const char* type : {"lambert", "blinn", "ggx"}) {
        TestScene test(probe_under(lights, glossy(type)));
        test.sample_the_dark();
        for (const Strategy& s : every_strategy_and_strata()) {
            const Outcome outcome = run_probe<float>(test, s, kernels<float>(), 300);
            EXPECT_EQ(outcome.result.luminance.mean, 0) << name_of(s);
            EXPECT_EQ(outcome.totals.shadow_rays + outcome.totals.invalid, 0U) << name_of(s);
        }
    }
}

/// Radii whose square is no float, a sun, a light at arm's length and one that touches the horizon,
/// all at once.
Lights hard_lights()
{
    return {make_light_of_power({0.5, 2, 0}, 1e-20, Vec3<double>(3)),
            make_light({0, 1.5e11, 1e10}, 7e8, Vec3<double>(2e4)),
            make_light({-1, 0.8, 0}, 1.2806, Vec3<double>(1)),
            make_light({2, 0.3, 0}, 0.3, Vec3<double>(1e12)),
            make_light({1, -2, 0}, 1e-3, Vec3<double>(5)),
            make_light({0, 3, 1}, 0.2, Vec3<double>(0)),
            make_light({0, 3, 1}, 0.2, Vec3<double>(1))};
}

TEST(EveryStrategy, IsFiniteUnderLightsThatAreHardAndOnEveryMaterial)
{
    for (const char* type : {"lambert", "lecture", "blinn", "ggx"})
        for (const Material& material : materials_of(type)) {
            const TestScene test(probe_under(hard_lights(), material));
            for (const Strategy& s : every_strategy_and_strata()) {
                const Outcome outcome = run_probe<float>(test, s, kernels<float>(), 256);
                ASSERT_EQ(outcome.totals.invalid, 0U) << name_of(s) << " on " << type;
                ASSERT_TRUE(std::isfinite(outcome.result.luminance.mean))
                    << name_of(s) << " on " << type;
            }
        }
}

/// 1 % too much of a probability, put in as a stage behind the one that chooses.
template <class T> void planted_error(const TileJob<T>&, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row)
        batch.probability[static_cast<std::size_t>(row)] *= T(1.01);
}

TEST(PlantedError, Of1PercentInAProbabilityIsSeen)
{
    const TestScene test(probe_under(three_lights_apart(), grey_floor()));
    for (const char* name : {"radiant-solid-angle/light", "radiant-solid-angle/power"}) {
        const ReadyStrategy<float> ready(test.lit, parse_strategy(name), kernels<float>(),
                                         seed_of_means);
        Pipeline<float> pipeline = ready.pipeline(0);
        const auto choose =
            std::find_if(pipeline.light.begin(), pipeline.light.end(),
                         [](const auto& stage) { return stage.kind == StageKind::choose; });
        pipeline.light.insert(choose + 1, {StageKind::choose, planted_error<float>});
        Workspace<float> workspace;
        Outcome outcome;
        workspace.run(ready.job(test.probes.tiles[0], test.probes.points), pipeline,
                      {.chunk = 1'000'000, .chunks = 1}, std::span(&outcome.result, 1), {}, {});
        EXPECT_GT(std::abs(z_of(outcome, reference(test))), z_bound(false_alarm, tests_at_most))
            << name;
    }
}

}  // namespace
}  // namespace mis
