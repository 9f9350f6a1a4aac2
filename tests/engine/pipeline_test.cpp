#include "mis/engine/pipeline.h"

#include "mis/trace/analytic.h"

#include "tests/engine/bench.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mis {
namespace {

int count_of(const std::vector<NamedStage<float>>& stages, StageKind kind)
{
    return static_cast<int>(
        std::count_if(stages.begin(), stages.end(), [&](const auto& s) { return s.kind == kind; }));
}

Pipeline<float> composed(const char* name, const Effects& effects)
{
    return compose(kernels<float>(), parse_strategy(name), "lambert", effects);
}

constexpr Effects everything{.lights = 5},
    nothing{.lights = 1,
            .on = EffectSet::all() - EffectSet{Effect::shadows, Effect::light_occlusion}};

TEST(Pipeline, HoldsNoStageThatTheSceneDoesNotCallFor)
{
    for (const char* name :
         {"uniform/balance", "uniform/balance/union", "uniform/balance/one-sample", "brdf"}) {
        const Pipeline<float> full = composed(name, everything), bare = composed(name, nothing);
        for (const auto* half : {&full.light, &full.bsdf})
            EXPECT_EQ(count_of(*half, StageKind::rays), half->empty() ? 0 : 1) << name;
        for (const auto* half : {&bare.light, &bare.bsdf}) {
            EXPECT_EQ(count_of(*half, StageKind::rays), 0) << name;
            EXPECT_EQ(count_of(*half, StageKind::light_occlusion), 0) << name;
        }
    }
    EXPECT_GE(count_of(composed("uniform/light", everything).light, StageKind::light_occlusion), 1);
    // The union looks along its direction for the nearest light anyway.
    EXPECT_EQ(
        count_of(composed("uniform/light/union", everything).light, StageKind::light_occlusion), 0);
    EXPECT_EQ(count_of(composed("uniform/light/union", everything).light, StageKind::meet), 1);
}

TEST(Pipeline, HasTheHalvesAndCountsOfItsStrategy)
{
    const Pipeline<float> light = composed("uniform/light@4+0", everything),
                          both = composed("uniform/power@3+2", everything);
    const Pipeline<float> brdf = composed("brdf", everything);
    EXPECT_TRUE(light.bsdf.empty());
    EXPECT_EQ(light.light_draws, 4);
    EXPECT_EQ(both.light_draws, 3);
    EXPECT_EQ(both.bsdf_draws, 2);
    EXPECT_FALSE(both.bsdf.empty());
    EXPECT_TRUE(brdf.light.empty());
    EXPECT_EQ(brdf.prepare, nullptr);
    EXPECT_EQ(brdf.bsdf_draws, 1);
    EXPECT_TRUE(composed("all/light", everything).draws_every_light);
}

TEST(Pipeline, RefusesWhatIsNotRegistered)
{
    EXPECT_THROW(compose(kernels<float>(), parse_strategy("brdf"), "velvet", everything),
                 std::out_of_range);
    EXPECT_THROW(compose(kernels<float>(), Strategy{"nearest", "balance"}, "lambert", everything),
                 std::out_of_range);
}

TEST(Pipeline, EveryStrategyComposesOnEveryBsdfForBothNumberTypes)
{
    for (const Strategy& s : every_strategy())
        for (const char* bsdf : {"lambert", "lecture", "blinn", "ggx"}) {
            EXPECT_NO_THROW(compose(kernels<float>(), s, bsdf, everything)) << name_of(s);
            EXPECT_NO_THROW(compose(kernels<double>(), s, bsdf, everything)) << name_of(s);
        }
}

/// What provably changes no value changes no bit, and saves its rays.
TEST(Effects, LeftOutOrSwitchedOnGiveTheSameBits)
{
    const Scene scene = probe_under({three_lights_apart()[0]}, grey_floor());
    const AnalyticTracer tracer(scene);
    const TestScene called(scene, &tracer, called_for(scene)),
        all(scene, &tracer, all_effects(scene));
    for (const Strategy& s : every_strategy()) {
        const Outcome a = run_probe<float>(called, s, kernels<float>(), 2000),
                      b = run_probe<float>(all, s, kernels<float>(), 2000);
        EXPECT_EQ(a.result.radiance_sum, b.result.radiance_sum) << name_of(s);
        EXPECT_EQ(a.result.luminance.m2, b.result.luminance.m2) << name_of(s);
        EXPECT_EQ(a.totals.shadow_rays, 0U) << name_of(s);
        EXPECT_GT(b.totals.shadow_rays, 0U) << name_of(s);
    }
}

/// Two draws of a light are two draws: 4 light draws have a quarter of one's variance.
TEST(Counts, NDrawsHaveOneNthOfTheVariance)
{
    const TestScene test(probe_under(three_lights_apart(), grey_floor()));
    for (const char* policy : {"uniform", "all"}) {
        const std::string name = std::string(policy) + "/light";
        const double one = run_probe<float>(test, parse_strategy(name), kernels<float>(), 40'000)
                               .result.luminance.variance();
        const double four =
            run_probe<float>(test, parse_strategy(name + "@4+0"), kernels<float>(), 40'000)
                .result.luminance.variance();
        EXPECT_NEAR(4 * four / one, 1, 0.05) << name;
    }
}

/// `all` with one draw each is the sum of as many strategies on one light.
TEST(All, IsTheSumOverLightsEachAlone)
{
    const Lights lights = three_lights_apart();
    double mean = 0, variance = 0;
    for (const Light& light : lights) {
        const Outcome one = run_probe<float>(TestScene(probe_under({light}, grey_floor())),
                                             parse_strategy("all/light"), kernels<float>(), 40'000);
        mean += one.result.luminance.mean, variance += one.result.luminance.variance();
    }
    const Outcome all = run_probe<float>(TestScene(probe_under(lights, grey_floor())),
                                         parse_strategy("all/light"), kernels<float>(), 40'000);
    EXPECT_NEAR(all.result.luminance.mean / mean, 1, 2e-3);
    EXPECT_NEAR(all.result.luminance.variance() / variance, 1, 0.05);
}

}  // namespace
}  // namespace mis
