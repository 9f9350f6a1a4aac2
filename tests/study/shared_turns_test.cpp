// Turns of shared directions over a study's points.
#include "mis/study/shared_turns.h"

#include "mis/run/serial.h"
#include "mis/run/tbb.h"
#include "mis/strategy/names.h"
#include "mis/study/mean_checks.h"
#include "mis/study/study.h"
#include "mis/trace/analytic.h"

#include "tests/study/small_picture.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

struct TurnsGround {
    Scene scene = small_picture();
    AnalyticTracer tracer{scene};
    LitScene lit{scene, &tracer, called_for(scene)};
    StudyPoints points = find_study_points(lit, any_executor(SerialExecutor{}));
    WorkspacePool<float> workspaces;
    AnyExecutor executor = any_executor(SerialExecutor{});
    StudyGround ground{lit, points, workspaces, executor, 1};
    std::vector<Strategy> strategies =
        strategies_named({"product/balance", "uniform/light", "all/light", "brdf"});

    std::vector<double> ones() const { return std::vector<double>(points.figure_lit, 1.0); }
    SharedTurns turns(int rounds_of_turn = 1) const
    {
        return SharedTurns(ground, ones(), strategies, {}, rounds_of_turn);
    }
};

TEST(SharedTurns, HaveTheVariancesOfTheirPoints)
{
    const TurnsGround of;
    SharedTurns turns = of.turns(2);
    for (int i = 0; i < 6; ++i) ASSERT_TRUE(turns.take(of.ground));
    EXPECT_EQ(turns.count(), 6U);
    EXPECT_EQ(turns.directions(), 13U * 32);  // the first round only centres
    const double share = double(of.points.figure_lit) / double(of.points.figure_points);
    for (std::size_t s = 0; s < of.strategies.size(); ++s) {
        const SharedFigures figures = turns.figures(s);
        EXPECT_NEAR(figures.variance / (share * turns.mean(s).value), 1, 1e-12);
        double of_turns = 0;
        for (const auto& turn : figures.region_variances)
            for (const double region : turn) of_turns += region / 6;
        EXPECT_NEAR(of_turns / figures.variance, 1, 1e-9) << name_of(of.strategies[s]);
    }
}

TEST(SharedTurns, MakeOneOfTwoWhereThereAreMany)
{
    const TurnsGround of;
    SharedTurns turns = of.turns();
    while (turns.count() < 127) ASSERT_TRUE(turns.take(of.ground));
    const auto before = turns.directions();
    ASSERT_TRUE(turns.take(of.ground));
    EXPECT_EQ(turns.count(), 64U);
    EXPECT_EQ(turns.directions(), before + 32);
    const SharedFigures figures = turns.figures(1);
    double of_turns = 0;
    for (const auto& turn : figures.region_variances)
        for (const double region : turn) of_turns += region / 64;
    EXPECT_NEAR(of_turns / figures.variance, 1, 1e-9);
    EXPECT_EQ(turns.directions_after_next(), turns.directions() + 64);
}

TEST(SharedTurns, AreWeighedAnewWithoutLoss)
{
    const TurnsGround of;
    SharedTurns turns = of.turns();
    for (int i = 0; i < 5; ++i) ASSERT_TRUE(turns.take(of.ground));
    const SharedFigures before = turns.figures(0);
    turns.weigh_again();
    const SharedFigures after = turns.figures(0);
    EXPECT_EQ(after.variance, before.variance);
    EXPECT_EQ(after.relative_variance, before.relative_variance);
    EXPECT_EQ(after.region_variances, before.region_variances);
    EXPECT_TRUE(after.relative_region_variances.empty());
    ASSERT_TRUE(turns.take(of.ground));
    const SharedFigures next = turns.figures(0);
    ASSERT_EQ(next.relative_region_variances.size(), 1U);
    double of_turn = 0;
    for (const double region : next.relative_region_variances[0]) of_turn += region;
    EXPECT_NEAR(of_turn / next.relative_variance, 1, 0.5);  // by weights 1/(μ² + ε²)
}

TEST(SharedTurns, DoNotCountWhereTheyAreStopped)
{
    const TurnsGround of;
    const std::atomic<bool> stop{true};
    StudyGround stopped = of.ground;
    stopped.stop = StopToken(&stop);
    SharedTurns turns(stopped, of.ones(), of.strategies, {});
    EXPECT_FALSE(turns.take(stopped));
    EXPECT_EQ(turns.count(), 0U);
}

TEST(MeanChecks, AreThoseOfTheSamples)
{
    TurnsGround of;
    SharedTurns turns = of.turns();
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(turns.take(of.ground));
    StrategyRun run(of.lit, of.points, of.strategies[1], 1);
    ASSERT_TRUE(run.sample_apart({.observations = 64}, of.workspaces, of.executor));
    const std::vector<MeanCheck> checks = mean_checks(run, of.points, turns, 1);
    ASSERT_EQ(checks.size(), 1 + of.points.regions);
    double mean = 0, variance = 0;
    for (std::size_t p = 0; p < of.points.figure_lit; ++p) {
        mean += run.results()[p].luminance.mean;
        variance += turns.at(1, p).value / 64;
    }
    const auto n = static_cast<double>(of.points.figure_points);
    EXPECT_NEAR(checks[0].own, mean / n, 1e-12);
    EXPECT_NEAR(checks[0].own_se, std::sqrt(variance) / n, 1e-12);
    EXPECT_LT(std::fabs(checks[0].own - checks[0].shared),
              5 * std::hypot(checks[0].own_se, checks[0].shared_se));
}

TEST(Study, SaysWhereItsVariancesComeFrom)
{
    const auto strategies = strategies_named({"product/balance", "uniform/light"});
    const Scene scene = small_picture();
    const AnalyticTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    const auto of = [&](const StudyOptions& options) {
        return run_study(lit, strategies, options, any_executor(TbbExecutor(2))).report;
    };
    const SceneReport shared = of({.spp = 256}), own = of({.own_samples = true, .spp = 256}),
                      sobol = of({.samples_per_scrambling = 16, .spp = 256});
    EXPECT_EQ(shared.directions, 252U);  // nine rounds of 28
    EXPECT_EQ(own.directions, 0U);
    EXPECT_EQ(sobol.directions, 0U);
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        EXPECT_EQ(shared.strategies[s].variance_from, VarianceSource::shared);
        EXPECT_EQ(own.strategies[s].variance_from, VarianceSource::own);
        EXPECT_EQ(sobol.strategies[s].variance_from, VarianceSource::own);
        const Interval& a = shared.strategies[s].variance;
        const Interval& b = own.strategies[s].variance;
        EXPECT_LT(std::fabs(std::log(a.value / b.value)),
                  2.5 * std::log(a.high / a.low) / 2 + 2.5 * std::log(b.high / b.low) / 2);
    }
}

}  // namespace
}  // namespace mis
