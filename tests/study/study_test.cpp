#include "mis/study/study.h"

#include "mis/run/serial.h"
#include "mis/run/tbb.h"
#include "mis/trace/analytic.h"
#include "mis/words/reasons.h"

#include "tests/study/small_picture.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace mis {
namespace {

/// A small picture of a floor with a blocker under three lights, and a probe.
Study study_of(const Scene& scene, const std::vector<Strategy>& strategies,
               const StudyOptions& options,
               const AnyExecutor& executor = any_executor(SerialExecutor{}))
{
    const AnalyticTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    return run_study(lit, strategies, options, executor);
}

void expect_the_same_on_any_number_of_threads(const Scene& scene,
                                              const std::vector<Strategy>& strategies,
                                              const StudyOptions& options)
{
    const Study one = study_of(scene, strategies, options);
    ASSERT_GT(one.report.shading_points, 500U);
    for (const int threads : {2, 3}) {
        const Study other =
            study_of(scene, strategies, options, any_executor(TbbExecutor(threads)));
        for (std::size_t s = 0; s < strategies.size(); ++s) {
            const StrategyReport &a = one.report.strategies[s], &b = other.report.strategies[s];
            EXPECT_EQ(a.samples, b.samples);
            EXPECT_EQ(a.mean, b.mean) << name_of(strategies[s]);
            EXPECT_EQ(a.variance.value, b.variance.value);
            EXPECT_EQ(a.relative_variance.value, b.relative_variance.value);
            EXPECT_EQ(a.rays_per_sample, b.rays_per_sample);
            EXPECT_EQ(a.probes[0].mean, b.probes[0].mean);
            EXPECT_EQ(a.status, b.status);
        }
    }
}

TEST(Study, HasTheSameFiguresOnAnyNumberOfThreads)
{
    const Scene scene = small_picture();
    const auto strategies = strategies_named(
        {"uniform/power", "solid-angle/balance", "all/light", "brdf", "power/light/union"});
    for (const StudyOptions& options :
         {StudyOptions{.spp = 37}, StudyOptions{.samples_per_scrambling = 8, .spp = 64}})
        expect_the_same_on_any_number_of_threads(scene, strategies, options);
}

/// At one probe: the variance of a sample at n is what scramblings say, and far below that of
/// independent samples; the means agree.
TEST(Study, OfSobolSequencesHasTheirVariance)
{
    const Scene scene = probe_under(three_lights_apart(), grey_floor());
    const auto strategies =
        strategies_named({"uniform/light", "power/power", "radiant-solid-angle/balance"});
    const Study independent = study_of(scene, strategies, {.spp = 65536});
    const Study sobol = study_of(scene, strategies, {.samples_per_scrambling = 64, .spp = 65536});
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        const StrategyReport &a = independent.report.strategies[s], &b = sobol.report.strategies[s];
        EXPECT_EQ(b.samples, 65536U);
        EXPECT_EQ(b.status, Status::ranked) << reason_words(b.reason);
        // One scrambling is more than enough for 1 %; less than one was not measured.
        EXPECT_GE(b.seconds_to_1_percent.value, 0.99 * 64 * b.seconds_per_sample.value);
        EXPECT_LT(2 * b.variance.high, a.variance.low) << name_of(strategies[s]);
        EXPECT_NEAR(b.probes[0].variance.value, b.variance.value, 0.1 * b.variance.value);
        // The root of variance/samples is the error of the mean, which is that over replicates.
        EXPECT_NEAR(b.probes[0].mean_se, std::sqrt(b.probes[0].variance.value / 65536),
                    1e-6 * b.probes[0].mean_se);
        EXPECT_LT(std::fabs(a.mean - b.mean),
                  z_bound(1e-4, 3) * std::hypot(a.probes[0].mean_se, b.probes[0].mean_se));
    }
}

/// At the first look half of the strategies have too few samples to be ranked: the two that are
/// apart by then do not end the study.
TEST(Study, WaitsForStrategiesThatCanStillBeResolved)
{
    Scene scene = probe_under(three_lights_apart(), grey_floor());
    std::vector<Strategy> strategies;
    for (const char* policy : {"uniform", "power", "solid-angle", "radiant-solid-angle"})
        for (const char* heuristic : {"light", "balance", "power"})
            strategies.push_back(parse_strategy(std::string(policy) + "/" + heuristic));
    const Study study = study_of(scene, strategies, {.default_seconds = 20});
    for (const StrategyReport& s : study.report.strategies)
        EXPECT_EQ(s.status, Status::ranked)
            << name_of(s.strategy) << ": " << reason_words(s.reason);
}

/// Of two lights `power` chooses one that nobody sees, all but always.
Scene picture_with_a_light_in_vain()
{
    Scene scene = small_picture();
    scene.lights.push_back(make_light_of_power({0, 4e5, 1e5}, 1e3, Vec3<double>(1e11)));
    scene.lights[0] = make_light_of_power({0, 1.5, 0}, 0.1, Vec3<double>(100));
    return scene;
}

/// A strategy that never drew what matters shows hardly a variance: it must not make the reference,
/// whether shared directions find its variance or, where there are none, the means find it out.
TEST(Study, IsNotLedAstrayByAStrategyThatIsNotResolved)
{
    const Scene scene = picture_with_a_light_in_vain();
    const std::vector<const char*> honest{"uniform/light", "all/light", "irradiance/light",
                                          "radiant-solid-angle/light", "product/light"};
    std::vector<const char*> with_another = honest;
    with_another.push_back("power/light");
    for (const std::uint32_t sequence : {0U, 4U}) {
        const StudyOptions options{.seed = 4, .samples_per_scrambling = sequence, .spp = 1024};
        const Study alone = study_of(scene, strategies_named(honest), options),
                    beside = study_of(scene, strategies_named(with_another), options);
        ASSERT_EQ(alone.report.strategies[0].status, Status::ranked)
            << reason_words(alone.report.strategies[0].reason);
        ASSERT_EQ(beside.report.strategies[0].status, Status::ranked)
            << reason_words(beside.report.strategies[0].reason);
        EXPECT_EQ(beside.report.strategies.back().status == Status::ranked, sequence == 0)
            << reason_words(beside.report.strategies.back().reason);
        EXPECT_EQ(beside.report.lacks_audit, sequence > 0);
        const double expected = alone.report.strategies[0].relative_variance.value;
        EXPECT_NEAR(beside.report.strategies[0].relative_variance.value, expected, 0.1 * expected);
        EXPECT_NEAR(beside.report.epsilon, alone.report.epsilon, 0.1 * alone.report.epsilon);
    }
}

TEST(Study, HasAReferenceAlsoWhereNothingIsResolved)
{
    Scene scene = picture_with_a_light_in_vain();
    const Study study = study_of(scene, strategies_named({"brdf", "uniform/light", "power/light"}),
                                 {.seed = 4, .own_samples = true, .spp = 2});
    for (const StrategyReport& s : study.report.strategies)
        EXPECT_EQ(s.status, Status::not_resolved);
    EXPECT_EQ(study.reference_weights[2], 0);  // all of its samples say 0
    EXPECT_GT(study.reference_weights[1], 1e-3);
}

/// No light is above the floor: every sample is 0, and that is proved.
TEST(Study, IsExactWhereNoPointFacesALight)
{
    Scene scene = probe_under(three_lights_apart(), grey_floor());
    for (Light& light : scene.lights) light.center.y = -5 - light.radius;
    const Study study = study_of(scene, strategies_named({"uniform/light", "brdf"}), {.spp = 8});
    for (const StrategyReport& s : study.report.strategies) {
        EXPECT_EQ(s.status, Status::ranked) << reason_words(s.reason);
        EXPECT_TRUE(s.exact);
        EXPECT_EQ(s.mean, 0);
    }
}

/// A light whose radiance is no number, which no file can bring in.
TEST(Study, TellsOfTheFirstSampleThatIsNoNumber)
{
    Scene scene = small_picture();
    scene.lights.front().radiance_radius = Vec3<float>(std::numeric_limits<float>::quiet_NaN());
    const auto strategies = strategies_named({"uniform/power"});
    const Study counted = study_of(scene, strategies, {.spp = 8});
    EXPECT_GT(counted.report.strategies[0].invalid_samples, 0U);
    struct Told {
        std::string name;
    };
    const auto tell = [](const Strategy& strategy, const SampleName&, double) {
        throw Told{name_of(strategy)};
    };
    try {
        study_of(scene, strategies, {.spp = 8, .on_invalid = tell});
        FAIL() << "nobody was told";
    } catch (const Told& told) {
        EXPECT_EQ(told.name, "uniform/power");
    }
}

TEST(Study, TakesEverySampleThatWasAskedFor)
{
    for (const std::uint64_t spp : {4, 5, 37, 64, 100}) {
        const Study study =
            study_of(small_picture(), strategies_named({"uniform/power"}), {.spp = spp});
        EXPECT_EQ(study.report.strategies[0].samples, spp * study.points->figure_lit);
        for (const PointResult& result : study.runs[0]->results())
            ASSERT_EQ(result.luminance.count, spp);
    }
}

TEST(Study, ListsProbesApartFromThePicture)
{
    const Study study = study_of(small_picture(), strategies_named({"uniform/power"}), {.spp = 64});
    ASSERT_EQ(study.report.strategies[0].probes.size(), 1U);
    EXPECT_EQ(study.points->figure_points + study.points->shading.background.size(), 40U * 24U);
    EXPECT_GT(study.report.strategies[0].probes[0].mean, 0);
}

TEST(Study, OfADarkProbeIsExactlyZero)
{
    Scene scene = small_picture();
    Probe inside = scene.probes[0];
    inside.position = scene.lights[0].center;
    scene.probes.push_back(inside);
    const Study study =
        study_of(scene, strategies_named({"uniform/light"}), {.seed = 1, .spp = 64});
    const std::vector<PointFigures>& probes = study.report.strategies[0].probes;
    ASSERT_EQ(probes.size(), 2U);
    EXPECT_GT(probes[0].mean, 0);
    EXPECT_EQ(probes[1].mean, 0);
    EXPECT_EQ(probes[1].mean_se, 0);
    EXPECT_EQ(probes[1].variance.high, 0);
}

TEST(Study, LeavesOutWhatIsPastTheBudget)
{
    Scene scene = probe_under(thirty_lights_one_dark(), grey_floor());
    while (scene.lights.size() < 100'000)
        scene.lights.push_back(scene.lights[scene.lights.size() % 30]);
    scene.camera = Camera{.position = {0, 2, 6}, .target = {0, 0, 0}, .resolution = {64, 64}};
    scene.surfaces.push_back({Quad{{-5, 0, -5}, {Vec3<double>{0, 0, 10}, {10, 0, 0}}}, 0});
    const Study study =
        study_of(scene, strategies_named({"all/light", "power/light"}), {.seconds = 3});
    // One sample of every point draws some 3e8 times: no machine does that in the time.
    EXPECT_EQ(study.report.strategies[0].status, Status::not_run);
    EXPECT_GT(study.report.strategies[0].estimated_seconds, 1.8);
    EXPECT_NE(study.report.strategies[1].status, Status::not_run);
}

TEST(Study, OfBlackLightsIsExact)
{
    Scene scene = small_picture();
    for (Light& light : scene.lights) light.radiance_radius = Vec3<float>(0.0F);
    const Study study =
        study_of(scene, strategies_named({"uniform/power", "power/light"}), {.spp = 32});
    for (const StrategyReport& s : study.report.strategies) {
        EXPECT_TRUE(s.exact) << name_of(s.strategy) << ": " << reason_words(s.reason);
        EXPECT_EQ(s.mean, 0);
    }
}

/// A floor with a lamp half in it.
Scene lamp_half_in_the_floor()
{
    Material white = grey_floor();
    white.diffuse = Vec3<double>(1);
    Scene scene;
    scene.materials = {white};
    scene.lights = {make_light({0, 0, 0.2}, 0.5, Vec3<double>(7))};
    scene.camera = Camera{
        .position = {0, -6, 3}, .target = {0, 0, 0}, .up = {0, 0, 1}, .resolution = {20, 14}};
    scene.surfaces.push_back({Quad{{-50, -50, 0}, {Vec3<double>{100, 0, 0}, {0, 100, 0}}}, 0});
    return scene;
}

/// What a report says of who is right and who leads by variance: no times.
std::string verdict_of(const SceneReport& report)
{
    std::string verdict;
    for (const StrategyReport& s : report.strategies)
        verdict += name_of(s.strategy) + " " + std::to_string(static_cast<int>(s.status)) +
                   (s.exact ? " exact" : "") + " " + std::to_string(s.rank) + "; ";
    return verdict;
}

/// The budgets of a study: samples per point, and two times that any machine keeps.
std::vector<StudyOptions> budgets(std::uint64_t seed)
{
    std::vector<StudyOptions> list;
    for (const std::uint64_t spp : {4, 16, 64, 1024, 16384})
        if (spp <= 1024 || scaled(16384) == 16384) list.push_back({.seed = seed, .spp = spp});
    for (const double seconds : {2.0, 4.0})
        if (seed == 1) list.push_back({.seed = seed, .seconds = seconds});
    return list;
}

/// Two strategies have no variance there. An estimate of it by other samples is above three of its
/// own errors now and then, whatever the number of samples.
TEST(Study, SaysTheSameOfExactStrategiesAtEveryBudget)
{
    const auto strategies =
        strategies_named({"uniform/light", "all/light/projected", "irradiance/light/projected"});
    const Scene scene = lamp_half_in_the_floor();
    for (const std::uint64_t seed : {1, 2, 3})
        for (const StudyOptions& options : budgets(seed)) {
            const SceneReport report = study_of(scene, strategies, options).report;
            // Of 4 samples a point each has but few: `uniform/light` may not be resolved yet.
            for (const std::size_t s : {1U, 2U}) {
                const StrategyReport& r = report.strategies[s];
                EXPECT_EQ(r.status, Status::ranked) << reason_words(r.reason);
                EXPECT_TRUE(r.exact);
                EXPECT_EQ(r.rank, 1) << verdict_of(report);
                EXPECT_EQ(r.variance.value, 0);
                EXPECT_EQ(r.variance.high, 0);
                EXPECT_EQ(r.relative_variance.value, 0);
                EXPECT_NEAR(r.mean / report.strategies[1].mean, 1, 1e-6);
            }
            EXPECT_FALSE(report.strategies[0].exact);
        }
}

/// Whatever effects are simulated: a proof needs none to be left out.
TEST(Study, ProvesThatAStrategyIsExactWhateverIsSimulated)
{
    const Scene scene = lamp_half_in_the_floor();
    const AnalyticTracer tracer(scene);
    const LitScene lit(scene, &tracer, all_effects(scene));
    const Study study =
        run_study(lit, strategies_named({"uniform/light", "irradiance/light/projected"}),
                  {.spp = 16}, any_executor(SerialExecutor{}));
    EXPECT_TRUE(study.report.strategies[1].exact)
        << reason_words(study.report.strategies[1].reason);
    EXPECT_FALSE(study.report.strategies[0].exact);
}

/// A lamp so small that all directions to it are one to a float: no theorem says so, the samples
/// do.
TEST(Study, CallsAStrategyExactWhoseSamplesAgreeToRounding)
{
    const Scene tiny =
                    probe_under({make_light({0.3, 2, 0.1}, 1e-8, Vec3<double>(1e9))}, grey_floor()),
                small =
                    probe_under({make_light({0.3, 2, 0.1}, 0.01, Vec3<double>(1e9))}, grey_floor());
    const auto strategies = strategies_named({"uniform/light", "power/power"});
    std::string first;
    for (const std::uint64_t spp : {4, 16, 64, 1024, 16384}) {
        const SceneReport report = study_of(tiny, strategies, {.spp = spp}).report;
        for (const StrategyReport& s : report.strategies) {
            EXPECT_TRUE(s.exact) << spp << ": " << reason_words(s.reason);
            EXPECT_EQ(s.variance.high, 0);
            EXPECT_EQ(s.probes.at(0).variance.high, 0);
        }
        if (first.empty()) first = verdict_of(report);
        EXPECT_EQ(verdict_of(report), first) << spp;
        for (const StrategyReport& s : study_of(small, strategies, {.spp = spp}).report.strategies)
            EXPECT_FALSE(s.exact);
    }
}

/// A light hidden by a ball, wholly: no sample shows anything, which proves nothing.
TEST(Study, DoesNotCallAStrategyExactThatIsBlackWithoutAProof)
{
    Scene scene = probe_under({make_light({0, 4, 0}, 0.1, Vec3<double>(5))}, grey_floor());
    scene.surfaces.push_back({SphereSurface{{0, 2, 0}, 0.5}, 0});
    for (const std::uint64_t spp : {4, 64, 1024}) {
        const Study study =
            study_of(scene, strategies_named({"all/light/projected", "brdf"}), {.spp = spp});
        for (const StrategyReport& s : study.report.strategies) {
            EXPECT_FALSE(s.exact);
            EXPECT_EQ(s.status, Status::not_resolved);
        }
    }
}

TEST(Study, StopsBetweenStrategiesAndSaysThatItIsPartial)
{
    const std::atomic<bool> stop{true};
    EXPECT_THROW(
        study_of(small_picture(), strategies_named({"uniform/power"}), {.spp = 64, .stop = &stop}),
        Stopped);  // not even its points are found
}

TEST(Audit, SeesWhatAStrategyNeverDraws)
{
    // Two dim lights, and between them one of a millionth of their solid angle that outshines both.
    const Scene scene = probe_under({make_light({2, 3, 0}, 0.5, Vec3<double>(10)),
                                     make_light({-2, 3, 1}, 0.4, Vec3<double>(10)),
                                     make_light({0, 3, 0}, 1e-4, Vec3<double>(1e9))},
                                    grey_floor());
    const auto strategies = strategies_named({"solid-angle/light", "power/light"});
    const Study study = study_of(scene, strategies, {.own_samples = true, .spp = 4096});
    EXPECT_EQ(study.report.strategies[0].status, Status::not_resolved)
        << study.report.strategies[0].variance.value;
    EXPECT_NE(study.report.strategies[1].status, Status::not_resolved)
        << reason_words(study.report.strategies[1].reason);
}

}  // namespace
}  // namespace mis
