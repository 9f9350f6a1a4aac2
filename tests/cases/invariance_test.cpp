// What must not change a result, over random scenes: to the last bit where the same random numbers
// meet the same numbers, by the agreement test's own bounds where they do not.
#include "mis/engine/render.h"
#include "mis/predict/predict.h"

#include "tests/cases/judge.h"
#include "tests/cases/measure.h"
#include "tests/predict/predict_cases.h"
#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

namespace mis {
namespace {

constexpr unsigned first_scene = 100, scenes = 8;

class Invariance : public testing::TestWithParam<unsigned> {
protected:
    Scene scene = random_scene(GetParam());
};
INSTANTIATE_TEST_SUITE_P(Scenes, Invariance, testing::Range(first_scene, first_scene + scenes));

/// body(place) for the centre of every sphere and the probe.
template <class Body> void for_each_place(Scene& scene, const Body& body)
{
    body(scene.probes[0].position);
    for (Light& light : scene.lights) body(light.center);
    for (Surface& surface : scene.surfaces) body(std::get<SphereSurface>(surface.shape).center);
}

// ── to the last bit ──

/// Lengths in 2^−20ths, so that sums with whole numbers are exact; nothing that occludes, as a
/// tracer has its own frame.
void round_lengths(Scene& scene)
{
    scene.surfaces.clear();
    for_each_place(scene, [](Vec3<double>& p) {
        for (int axis = 0; axis < 3; ++axis) p[axis] = std::round(p[axis] * 0x1p20) * 0x1p-20;
    });
}

template <class T> void expect_same_bits(const Scene& a, const Scene& b)
{
    const ReadyCase one(a), other(b);
    for (const std::string_view set : instruction_sets())
        for (const Strategy& s : every_plain_strategy()) {
            const Outcome x = run_case<T>(one, s, kernels_of<T>(set), 300, 1),
                          y = run_case<T>(other, s, kernels_of<T>(set), 300, 1);
            ASSERT_EQ(x.result.radiance_sum, y.result.radiance_sum) << set << " " << name_of(s);
            ASSERT_EQ(x.result.luminance.m2, y.result.luminance.m2) << set << " " << name_of(s);
        }
}

TEST_P(Invariance, TranslationByWholeNumbersChangesNoBit)
{
    round_lengths(scene);
    Scene moved = scene;
    for_each_place(moved, [](Vec3<double>& p) { p += Vec3<double>{1 << 20, -3, 1 << 25}; });
    expect_same_bits<float>(scene, moved);
    expect_same_bits<double>(scene, moved);
}

TEST_P(Invariance, ScaleByAPowerOfTwoChangesNoBit)
{
    scene.surfaces.clear();
    for (const double factor : {0x1p-20, 0x1p20}) {
        Scene resized = scene;
        for_each_place(resized, [&](Vec3<double>& p) { p *= factor; });
        for (Light& light : resized.lights) {
            light.radius *= factor;
            light.radiance_radius *= static_cast<float>(factor);
        }
        expect_same_bits<float>(scene, resized);
        expect_same_bits<double>(scene, resized);
    }
}

/// The twin of both: a change in the last places of one coordinate is seen.
TEST(InvarianceTwin, SeesALightThatMovedByAMillionth)
{
    const Scene scene = random_scene(first_scene + 1);
    Scene moved = scene;
    moved.lights[0].center.x += 1e-6;
    const Strategy s = parse_strategy("all/light");
    EXPECT_NE(run_case<double>(ReadyCase(scene), s, kernels<double>(), 300, 1).result.radiance_sum,
              run_case<double>(ReadyCase(moved), s, kernels<double>(), 300, 1).result.radiance_sum);
}

/// Samples in one run are the samples in several.
TEST_P(Invariance, SamplesTakenInPartsAreTheSameSamples)
{
    const ReadyCase ready(scene);
    for (const Strategy& s : every_plain_strategy()) {
        const ReadyStrategy<float> strategy(ready.test.lit, s, kernels<float>(), 1);
        const Tile& tile = ready.test.probes.tiles.at(0);
        Workspace<float> workspace;
        const auto add = [&](PointResult& to, std::uint64_t first, int samples) {
            workspace.run(
                strategy.job(tile, ready.test.probes.points), strategy.pipeline(tile.material),
                {.first = first, .chunk = samples, .chunks = 1}, std::span(&to, 1), {}, {});
        };
        PointResult whole, parts;
        add(whole, 0, 600);
        add(parts, 0, 1), add(parts, 1, 299), add(parts, 300, 300);
        EXPECT_EQ(whole.luminance.count, parts.luminance.count);
        EXPECT_EQ(whole.radiance_sum, parts.radiance_sum) << name_of(s);
        // Of samples that are equal but for rounding, the means' rounding is all there is.
        const double rounding = 600 * square(1e-12 * whole.luminance.mean);
        EXPECT_NEAR(whole.luminance.m2, parts.luminance.m2, 1e-12 * whole.luminance.m2 + rounding)
            << name_of(s);
    }
}

/// `all` is linear in the lights: a sample is the sum of those where one light alone shines. Its
/// weights know no radiance, so with the same random numbers that holds sample by sample.
TEST_P(Invariance, AllIsTheSumOverLights)
{
    const ReadyCase whole(scene);
    for (const Strategy& s : every_plain_strategy()) {
        if (s.policy != "all") continue;
        Vec3<double> sum(0);
        for (std::size_t j = 0; j < scene.lights.size(); ++j) {
            Scene one = scene;
            for (std::size_t k = 0; k < one.lights.size(); ++k)
                if (k != j) one.lights[k].radiance_radius = Vec3<float>(0);
            sum += run_case<float>(ReadyCase(one), s, kernels<float>(), 300, 1).result.radiance_sum;
        }
        const Vec3<double> all =
            run_case<float>(whole, s, kernels<float>(), 300, 1).result.radiance_sum;
        EXPECT_NEAR(luminance(sum), luminance(all), 1e-13 * luminance(all)) << name_of(s);
    }
}

/// One thread per body.
AnyExecutor many_threads()
{
    return {3, [](std::size_t n, const std::function<void(std::size_t)>& body) {
                std::vector<std::thread> threads;
                for (std::size_t i = n; i-- > 0;) threads.emplace_back(body, i);
                for (std::thread& thread : threads) thread.join();
            }};
}

/// The random scene's lights over a floor, seen by a camera.
Scene picture_of(Scene scene)
{
    const Probe& probe = scene.probes[0];
    const Vec3<double> across = frame_around(probe.normal).x, along = frame_around(probe.normal).y;
    const Quad floor{probe.position - across * 4.0 - along * 4.0, {across * 8.0, along * 8.0}};
    scene.surfaces.push_back({floor, 0});
    scene.camera = Camera{.position = probe.position + probe.normal * 0.5 + across * 0.5,
                          .target = probe.position,
                          .up = probe.normal,
                          .vertical_fov_degrees = 60,
                          .resolution = {40, 40}};
    return scene;
}

std::vector<Vec3<double>> sums_of_picture(const Scene& scene, const Strategy& s,
                                          const AnyExecutor& executor)
{
    const AnalyticTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    const ReadyStrategy<float> ready(lit, s, kernels<float>(), 1);
    WorkspacePool<float> workspaces;
    Band band = find_band(lit, 0, scene.camera->resolution[1], executor);
    light_band(ready, band, 0, 5, workspaces, executor);
    std::vector<Vec3<double>> sums;
    for (const PointResult& result : band.results) sums.push_back(result.radiance_sum);
    return sums;
}

TEST_P(Invariance, TheNumberOfThreadsChangesNoBit)
{
    const Scene picture = picture_of(scene);
    for (const Strategy& s :
         strategies_of({"all/light", "uniform/power", "radiant-solid-angle/balance/union",
                        "power/maximum/one-sample", "brdf"})) {
        const auto alone = sums_of_picture(picture, s, any_executor(SerialExecutor()));
        ASSERT_FALSE(alone.empty());
        EXPECT_EQ(alone, sums_of_picture(picture, s, many_threads())) << name_of(s);
    }
}

// ── in the mean ──

/// Every policy and technique; heuristics without jumps, as their predictions share their nodes.
const std::vector<std::string_view> smooth_strategies{
    "uniform/light",
    "power/light/union",
    "solid-angle/light",
    "radiant-solid-angle/light",
    "all/light",
    "uniform/balance/union",
    "power/power",
    "solid-angle/power/one-sample",
    "radiant-solid-angle/balance/union/one-sample",
    "all/balance",
    "all/power/union",
    "irradiance/light/projected",
    "irradiance/power",
    "product/light",
    "product/balance/projected",
    "tree/light/projected",
    "tree/power/union",
    "brdf",
    "cosine",
    "hemisphere"};

/// Changes of a scene that are tested in the mean.
constexpr int changes = 4;

/// False alarm: 1e-6 for the whole file; the seed is fixed. Rounding is that of agreement_test.cpp
/// for materials as dull as these.
Strictness strictness()
{
    const double tests = 2.0 * changes * scenes * static_cast<double>(smooth_strategies.size());
    return {1e-6 / tests, 2e-5};
}

std::vector<Predicted> predicted(const Scene& scene)
{
    return predict(scene, scene.probes[0], strategies_of(smooth_strategies), {.smooth = 1e-5});
}

/// The engine on `changed` has the mean that is predicted for `scene`; its variance is predicted
/// for `changed` itself.
void expect_same_mean(const Scene& scene, const Scene& changed, bool has_same_variance)
{
    const std::vector<Predicted> before = predicted(scene),
                                 after = has_same_variance ? before : predicted(changed);
    const std::vector<Strategy> strategies = strategies_of(smooth_strategies);
    const ReadyCase ready(changed);
    for (std::size_t i = 0; i < strategies.size(); ++i) {
        Predicted p = after[i];
        EXPECT_NEAR(p.mean, before[i].mean, p.mean_error + before[i].mean_error);
        p.mean = before[i].mean, p.mean_error = before[i].mean_error;
        const Outcome outcome =
            run_case<float>(ready, strategies[i], kernels<float>(), scaled(20'000), 1);
        EXPECT_EQ(disagreement(outcome.result.luminance, p, strictness()), "")
            << name_of(strategies[i]);
    }
}

TEST_P(Invariance, RotationChangesNoMeanAndNoVariance)
{
    Uniforms uniforms(GetParam());
    const Frame<double> frame = frame_around(uniforms.direction());
    Scene turned = scene;
    for_each_place(turned, [&](Vec3<double>& p) { p = frame.to_world(p); });
    turned.probes[0].normal = frame.to_world(scene.probes[0].normal);
    turned.probes[0].outgoing = frame.to_world(scene.probes[0].outgoing);
    expect_same_mean(scene, turned, true);
}

TEST_P(Invariance, TheOrderOfLightsChangesNoMeanAndNoVariance)
{
    Scene reversed = scene;
    std::reverse(reversed.lights.begin(), reversed.lights.end());
    expect_same_mean(scene, reversed, true);
}

/// Some hundred, so that tables have blocks and the hierarchy has levels.
TEST(Invariance, TheOrderOfManyLightsChangesNoMeanAndNoVariance)
{
    Scene many = random_scene(first_scene);
    Uniforms uniforms(17);
    const Probe& probe = many.probes[0];
    const Light pattern = many.lights[0];
    many.lights.clear();
    for (int k = 0; k < 200; ++k) {
        const Vec3<double> aside = uniforms.direction() + probe.normal * 1.1;
        many.lights.push_back(pattern);
        many.lights.back().center = probe.position + aside * (2.0 + uniforms());
        many.lights.back().radius = 0.001 + 0.004 * uniforms();
    }
    Scene shuffled = many;
    std::reverse(shuffled.lights.begin(), shuffled.lights.end());
    for (std::size_t k = 0; k + 7 < shuffled.lights.size(); k += 3)
        std::swap(shuffled.lights[k], shuffled.lights[k + 7]);
    const auto strategies =
        strategies_of({"power/light", "irradiance/light", "product/power", "tree/light"});
    const auto before = predict(many, many.probes[0], strategies, {.smooth = 1e-6}),
               after = predict(shuffled, shuffled.probes[0], strategies, {.smooth = 1e-6});
    for (std::size_t i = 0; i < strategies.size(); ++i) {
        EXPECT_NEAR(after[i].mean, before[i].mean, 1e-5 * before[i].mean);
        const Outcome outcome = run_case<float>(ReadyCase(shuffled), strategies[i],
                                                kernels<float>(), scaled(20'000), 1);
        // A hierarchy, and a table of blocks in float, price the lights as their order has it.
        EXPECT_EQ(disagreement(outcome.result.luminance, after[i], strictness()), "")
            << name_of(strategies[i]);
    }
}

TEST_P(Invariance, ACopyListedAfterALightChangesNoMean)
{
    Scene doubled = scene;
    Light copy = scene.lights[0];
    copy.radiance_radius *= 3.F;
    doubled.lights.push_back(copy);
    expect_same_mean(scene, doubled, false);
}

TEST_P(Invariance, ABlackLightThatHidesNothingChangesNoMean)
{
    const Probe& probe = scene.probes[0];
    Scene more = scene;
    const Light& light = scene.lights.back();
    more.lights.insert(more.lights.begin(),
                       make_light(probe.position - probe.normal * 3.0, 0.5, Vec3<double>(0)));
    more.lights.push_back(make_light(probe.position + (light.center - probe.position) * 9.0,
                                     light.radius, Vec3<double>(0)));
    expect_same_mean(scene, more, false);
}

/// The twin: a copy listed *before* its light hides it, and three times the radiance is seen.
TEST(InvarianceTwin, SeesACopyListedBefore)
{
    const Scene scene = random_scene(first_scene + 1);
    Scene doubled = scene;
    Light copy = scene.lights[0];
    copy.radiance_radius *= 3.F;
    doubled.lights.insert(doubled.lights.begin(), copy);
    const Strategy s = parse_strategy("all/light");
    const Predicted p = predict(scene, scene.probes[0], std::span(&s, 1))[0];
    const Outcome outcome =
        run_case<float>(ReadyCase(doubled), s, kernels<float>(), scaled(20'000), 1);
    EXPECT_NE(disagreement(outcome.result.luminance, p, strictness()), "");
}

}  // namespace
}  // namespace mis
