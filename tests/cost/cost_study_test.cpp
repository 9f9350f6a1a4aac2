#include "mis/cost/cost_study.h"

#include "mis/cost/reference.h"
#include "mis/predict/predict.h"
#include "mis/run/serial.h"
#include "mis/run/tbb.h"
#include "mis/trace/analytic.h"
#include "mis/words/cost_remarks.h"
#include "tests/cost/synthetic_cost.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

const AnyExecutor serial = any_executor(SerialExecutor{});

std::vector<CostChoice> choices_named(std::initializer_list<const char*> names)
{
    std::vector<CostChoice> choices;
    for (const char* name : names) choices.push_back({parse_strategy(name)});
    return choices;
}

Scene two_probes()
{
    Scene scene = probe_under(three_lights_apart(), grey_floor());
    scene.probes.push_back(scene.probes[0]);
    scene.probes[1].position = {0.5, 0, -0.3};
    return scene;
}

/// A floor, with a ball on it, under the same lights: 16 x 12 pixels.
Scene picture_to_cost()
{
    Scene scene = probe_under(three_lights_apart(), grey_floor());
    scene.camera = Camera{.position = {0, 2, 6}, .target = {0, 0, 0}, .resolution = {16, 12}};
    scene.surfaces.push_back({Quad{{-5, 0, -5}, {Vec3<double>{0, 0, 10}, {10, 0, 0}}}, 0});
    scene.surfaces.push_back({SphereSurface{{0.5, 0.6, 0.5}, 0.3}, 0});
    return scene;
}

CostSceneReport costs_of(const Scene& scene, const std::vector<CostChoice>& choices,
                         const CostOptions& options, const AnyExecutor& executor = serial)
{
    const AnalyticTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    return run_cost_study(lit, choices, options, executor);
}

TEST(CostStudy, FindsTheVarianceThatQuadratureSays)
{
    const Scene scene = two_probes();
    const std::vector<CostChoice> choices =
        choices_named({"uniform/power", "power/light", "solid-angle/balance", "uniform/power@4+1"});
    const CostSceneReport report = costs_of(scene, choices, {.spp = 32});
    EXPECT_TRUE(report.reference.exact);
    EXPECT_LT(report.reference.error, 1e-6);
    EXPECT_GT(report.copies, 1U);
    for (std::size_t s = 0; s < choices.size(); ++s) {
        double expected = 0;
        for (const Probe& probe : scene.probes) {
            const Predicted p = predict(scene, probe, std::span(&choices[s].strategy, 1)).front();
            expected += 0.5 * p.variance / (p.mean * p.mean);
        }
        const CostCurveReport& curve = report.curves[s];
        // 95 % intervals; the seed is fixed. Twice as wide, so that four of them hold surely.
        const double half_width = curve.relative_variance.high - curve.relative_variance.value;
        EXPECT_NEAR(curve.relative_variance.value, expected, 2 * half_width) << name_of(curve);
        EXPECT_LT(half_width, 0.1 * expected) << name_of(curve);
        EXPECT_TRUE(curve.fits) << name_of(curve);
        ASSERT_EQ(curve.points.size(), 6U);
        EXPECT_EQ(curve.points[5].samples, 32U);
        EXPECT_NEAR(curve.points[0].error.value, std::sqrt(expected), 0.1 * std::sqrt(expected));
    }
}

/// The gain is the exact variance of independent samples, which quadrature says, over n times the
/// squared error; and it grows with the samples.
TEST(CostStudy, FindsTheGainOfSobolSequences)
{
    const Scene scene = two_probes();
    const std::vector<CostChoice> choices =
        choices_named({"uniform/light", "power/power", "all/light"});
    const CostSceneReport report = costs_of(scene, choices, {.is_sobol = true, .spp = 64});
    ASSERT_TRUE(report.reference.exact);
    EXPECT_TRUE(report.is_sobol);
    for (std::size_t c = 0; c < choices.size(); ++c) {
        double exact = 0;
        for (const Probe& probe : scene.probes) {
            const Predicted p = predict(scene, probe, std::span(&choices[c].strategy, 1))[0];
            exact += p.variance / (p.mean * p.mean) / 2;
        }
        double last = 0;
        for (const CostPoint& point : report.curves[c].points) {
            if (point.samples < 4) continue;
            const double squared = point.error.value * point.error.value;
            EXPECT_NEAR(point.gain.value, exact / (double(point.samples) * squared),
                        0.05 * point.gain.value)
                << name_of(report.curves[c]) << " " << point.samples;
            EXPECT_GT(point.gain.low, last);
            EXPECT_LT(point.gain.low, point.gain.value);
            last = point.gain.value > 1 ? 1 : last;
        }
        EXPECT_GT(report.curves[c].points.back().gain.low, 3);
        EXPECT_NEAR(report.curves[c].points.front().gain.value, 1, 1e-9);  // of one sample
    }
    const CostSceneReport independent = costs_of(scene, choices, {.spp = 4});
    EXPECT_TRUE(std::isnan(independent.curves[0].points[2].gain.value));
}

TEST(CostStudy, MeasuresTheSameAgainstAPooledReferenceAsAgainstTheExactOne)
{
    const Scene scene = two_probes();
    const LitScene lit(scene, nullptr, called_for(scene));
    const StudyPoints points = find_study_points(lit, serial);
    WorkspacePool<float> workspaces;
    const StudyGround ground{lit, points, workspaces, serial};
    const auto exact = exact_reference(ground);
    ASSERT_TRUE(exact);
    const CostReference pooled = pooled_reference(ground, {.samples = 20000});
    EXPECT_TRUE(pooled.report.agrees);
    EXPECT_EQ(pooled.report.samples, 20000U);
    ASSERT_EQ(pooled.means.size(), 2U);
    for (std::size_t p = 0; p < 2; ++p)
        EXPECT_NEAR(pooled.means[p], exact->means[p], 5 * pooled.report.error * exact->means[p]);
    EXPECT_GT(pooled.report.error, 1e-4);
    EXPECT_LT(pooled.report.error, 1e-2);
    // And it is as far off as it says: the mean of many.
    double squares = 0, said = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const StudyGround other{lit, points, workspaces, serial, seed};
        const CostReference r = pooled_reference(other, {.samples = 64});
        for (std::size_t p = 0; p < 2; ++p)
            squares += 0.005 * std::pow(r.means[p] / exact->means[p] - 1, 2);
        said += 0.01 * r.error.squared;
    }
    EXPECT_NEAR(squares / said, 1, 0.4);  // 200 squares: a standard error of 0.1
}

TEST(CostStudy, HasTheSameFiguresOnAnyNumberOfThreads)
{
    const Scene scene = picture_to_cost();
    std::vector<CostChoice> choices =
        choices_named({"uniform/power", "power/light", "solid-angle/balance"});
    choices.push_back({choices[0].strategy, Precision::in_double});
    const CostSceneReport one = costs_of(scene, choices, {.spp = 8});
    const CostSceneReport three =
        costs_of(scene, choices, {.spp = 8}, any_executor(TbbExecutor(3)));
    EXPECT_FALSE(one.reference.exact);
    for (std::size_t c = 0; c < choices.size(); ++c) {
        ASSERT_EQ(one.curves[c].points.size(), 4U);
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(one.curves[c].points[k].error.value, three.curves[c].points[k].error.value);
            EXPECT_EQ(one.curves[c].points[k].error.high, three.curves[c].points[k].error.high);
        }
        EXPECT_EQ(one.curves[c].slope.value, three.curves[c].slope.value);
    }
    // Float and double err alike, but not equally.
    EXPECT_NEAR(one.curves[3].points[0].error.value / one.curves[0].points[0].error.value, 1, 1e-3);
    EXPECT_NE(one.curves[3].points[0].error.value, one.curves[0].points[0].error.value);
}

TEST(CostStudy, AddsTheBestInDoubleAndWithFourLightDraws)
{
    const CostSceneReport report = costs_of(picture_to_cost(), choices_named({"uniform/power"}),
                                            {.spp = 8, .adds_twins = true});
    ASSERT_EQ(report.curves.size(), 3U);
    EXPECT_EQ(name_of(report.curves[1]), "uniform/power in double");
    EXPECT_EQ(name_of(report.curves[2]), "uniform/power@4+1");
    for (const CostCurveReport& curve : report.curves) EXPECT_EQ(curve.points.size(), 4U);
    EXPECT_LT(report.curves[2].relative_variance.value,
              0.9 * report.curves[0].relative_variance.value);
}

/// With a number of samples no clock decides which curves there are, nor where all is black.
TEST(CostStudy, ChoosesTheSameTwinsOnAnyMachine)
{
    const std::vector<CostChoice> choices =
        choices_named({"uniform/power", "power/power", "all/power", "brdf"});
    const auto names = [&](const AnyExecutor& executor) {
        std::vector<std::string> found;
        for (const CostCurveReport& curve :
             costs_of(picture_to_cost(), choices, {.spp = 8, .adds_twins = true}, executor).curves)
            found.push_back(name_of(curve));
        return found;
    };
    const std::vector<std::string> one = names(serial);
    EXPECT_EQ(one, names(any_executor(TbbExecutor(3))));
    EXPECT_EQ(one.at(4), "all/power in double");  // the least variance for its draws
}

TEST(CostStudy, SaysThatABlackSceneIsBlack)
{
    Scene scene = picture_to_cost();
    for (Light& light : scene.lights) light.radiance_radius = {0, 0, 0};
    const CostSceneReport report = costs_of(scene, choices_named({"uniform/power"}), {.spp = 4});
    EXPECT_TRUE(report.is_black);
    const std::vector<std::string> sentences = sentences_of(report);
    ASSERT_EQ(sentences.size(), 1U);
    EXPECT_NE(sentences[0].find("black"), std::string::npos) << sentences[0];
}

/// All lights are drawn for the reference where that is best, also of more than a few lights.
TEST(CostStudy, ItsReferenceDrawsAllOfSomeLightsWhereThatIsBest)
{
    Scene scene = picture_to_cost();
    scene.lights.clear();
    for (int j = 0; j < 40; ++j)
        scene.lights.push_back(
            make_light({0.3 * (j - 20), 3, 0.1 * (j % 7)}, 0.05, Vec3<double>(1 + j % 5)));
    const CostSceneReport report = costs_of(scene, choices_named({"uniform/power"}), {.spp = 2});
    EXPECT_EQ(report.reference.sources.size(), 4U);
    EXPECT_EQ(report.reference.sources.front(), "all/power");
    EXPECT_TRUE(report.reference.agrees);
    EXPECT_LT(report.reference.error, 0.02);
}

/// One curve is known to reach 1 %; another was ahead of it when the reference told no more.
TEST(CostSentences, NameWhatMayBeSooner)
{
    const CostGround ground{.points = 1000, .threads = 1, .reference = {1e-3, 1e-6, 1e-3}};
    CostSceneReport report;
    report.shading_points = 1000, report.replicates = 8;
    report.curves = {curve_report(measured({.variance = 1, .reference = 1e-3}), ground),
                     curve_report(measured({.name = "all/power",
                                            .variance = 1e-4,
                                            .reference = 1e-3,
                                            .per_sample = 3e-7,
                                            .levels = 1}),
                                  ground)};
    ASSERT_EQ(report.curves[1].times[3].reach, Reach::unknown);
    const std::vector<std::string> sentences = sentences_of(report);
    ASSERT_GE(sentences.size(), 2U);
    EXPECT_EQ(sentences[0].rfind("Of those whose time is known, power/power", 0), 0U)
        << sentences[0];
    EXPECT_NE(sentences[1].find("by all/power; when"), std::string::npos) << sentences[1];
}

TEST(CostChoices, AreTheFirstInDoubleAndTheFirstThatMixesWithFourLightDraws)
{
    const std::vector<Strategy> by_time{parse_strategy("brdf"), parse_strategy("power/light"),
                                        parse_strategy("power/power")};
    const std::vector<CostChoice> twins = twins_of(by_time);
    ASSERT_EQ(twins.size(), 2U);
    EXPECT_EQ(twins[0], (CostChoice{by_time[0], Precision::in_double}));
    EXPECT_EQ(twins[1], (CostChoice{parse_strategy("power/power@4+1")}));
    EXPECT_TRUE(twins_of({}).empty());
    EXPECT_EQ(twins_of(std::span(by_time).first(2)).size(), 1U);
}

TEST(CostStudy, EndsWithWhatThereIsWhenStopped)
{
    std::atomic<bool> stop = false;
    CostOptions options{.spp = 64, .stop = &stop};
    options.progress = [&](double, const std::string& doing) {
        stop = stop || doing.rfind("8 samples", 0) == 0;
    };
    const CostSceneReport report =
        costs_of(picture_to_cost(), choices_named({"uniform/power"}), options);
    EXPECT_TRUE(report.partial);
    EXPECT_EQ(report.curves[0].points.size(), 3U);  // 1, 2 and 4
}

TEST(CostStudy, SaysSoWhereNothingIsLit)
{
    Scene scene = two_probes();
    for (Probe& probe : scene.probes) probe.outgoing = -probe.outgoing;  // seen from below
    const CostSceneReport report = costs_of(scene, choices_named({"uniform/power"}), {.spp = 4});
    ASSERT_EQ(report.curves.size(), 1U);
    EXPECT_TRUE(std::holds_alternative<reason::NothingLit>(report.curves[0].reason));
}

}  // namespace
}  // namespace mis
