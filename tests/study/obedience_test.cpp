// What a study does before its first sample: it ends when it is told to, and takes no longer where
// lights stand one behind the other.
#include "mis/cost/reference.h"
#include "mis/run/serial.h"
#include "mis/strategy/names.h"
#include "mis/study/affordable.h"
#include "mis/study/explain.h"
#include "mis/study/rounds.h"
#include "mis/study/study.h"
#include "mis/study/study_audit.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// Lights one behind the other, all of one solid angle from the probe: the first, of radiance 1,
/// hides the others, which are a thousand times brighter.
Scene stacked_scene(int count)
{
    Lights lights;
    for (int k = 1; k <= count; ++k)
        lights.push_back(
            make_light({0, 2.0 * k * (1 + 1e-9 * k), 0}, k, Vec3<double>(k == 1 ? 1.0 : 1000.0)));
    return probe_under(lights, grey_floor());
}

std::vector<Strategy> strategies_called(const std::vector<const char*>& names)
{
    std::vector<Strategy> strategies;
    for (const char* name : names) strategies.push_back(parse_strategy(name));
    return strategies;
}

const AnyExecutor one_thread = any_executor(SerialExecutor{});

/// A scene, its points, and what it takes to sample them until a token is up.
struct StoppableGround {
    explicit StoppableGround(Scene made) : scene(std::move(made)) {}

    StudyGround until(const StopToken& stop)
    {
        return {lit, points, workspaces, one_thread, 1, stop};
    }

    Scene scene;
    LitScene lit{scene, nullptr, called_for(scene)};
    StudyPoints points = find_study_points(lit, one_thread);
    WorkspacePool<float> workspaces;
};

/// How often a token is asked.
struct Asks {
    int count = 0, most = std::numeric_limits<int>::max();
    std::function<bool()> asked = [this] { return ++count > most; };
    StopToken token() const { return StopToken(&asked); }
};

/// albedo/π · L · π sin²θ; twelve strategies' worth of other tests see that it can fail.
TEST(Stacked, TheFirstLightAloneIsSeen)
{
    constexpr double false_alarm = 1e-6;  // for all three together
    const std::vector<Strategy> strategies =
        strategies_called({"brdf", "uniform/power", "tree/power"});
    const Scene scene = stacked_scene(300);
    const LitScene lit(scene, nullptr, called_for(scene));
    const Study study = run_study(lit, strategies, {.spp = 16384}, one_thread);
    for (const StrategyReport& s : study.report.strategies) {
        EXPECT_NEAR(s.mean, 0.5 * 0.25, z_bound(false_alarm, 3) * s.mean_se) << name_of(s.strategy);
        EXPECT_LT(s.mean_se, 0.1 * s.mean) << name_of(s.strategy);  // so that the test can fail
    }
}

/// Did it end before there was an audit?
bool is_without_audit(const StudyGround& ground, std::span<const double> weights,
                      std::span<const Strategy> strategies)
{
    try {
        return StudyAudit(ground, weights, strategies).is_empty();
    } catch (const Stopped&) {
        return true;
    }
}

TEST(Stopping, EndsEveryPhaseBeforeTheFirstSample)
{
    StoppableGround ground(stacked_scene(2000));
    const std::vector<Strategy> strategies = strategies_called({"tree/power", "all/light"});
    const std::vector<double> weights(ground.points.shading.points.size(), 1.0);
    for (const int most : {0, 1}) {
        Asks asks{.most = most};
        const StopToken stop = asks.token();
        StoppableGround fresh(stacked_scene(2000));
        EXPECT_TRUE(is_without_audit(fresh.until(stop), weights, strategies)) << most;
        asks.count = 0;
        EXPECT_THROW(StoppableGround(stacked_scene(2000)).lit.policy("tree", stop), Stopped);
        asks.count = 0;
        EXPECT_THROW(StoppableGround(stacked_scene(2000)).lit.order(stop), Stopped);
        asks.count = 0;
        EXPECT_THROW(rough_weights(ground.until(stop)), Stopped);
        asks.count = 0;
        EXPECT_THROW(best_tile_factors(ground.until(stop), strategies), Stopped);
        asks.count = 0;
        const StrategyRun run(ground.lit, ground.points, strategies[1], 1);
        EXPECT_THROW(run.try_out(1, 4, ground.workspaces, stop), Stopped) << most;
    }
    Asks none{.most = 0};
    EXPECT_THROW(explain(ground.lit, stoppable(one_thread, none.token())), Stopped);
    EXPECT_THROW(pooled_reference(ground.until(none.token()), {}), Stopped);
    EXPECT_THROW(find_study_points(ground.lit, stoppable(one_thread, none.token())), Stopped);
}

TEST(Stopping, LeavesWhatWasNotTriedOutUnaffordableAndSaysSo)
{
    StoppableGround ground(stacked_scene(20));
    const std::vector<Strategy> strategies = strategies_called({"tree/power", "brdf"});
    Asks none{.most = 0};
    for (const CostEstimate& cost : estimate_costs(ground.until(none.token()), strategies, 32, 1)) {
        EXPECT_FALSE(cost.is_affordable);
        EXPECT_FALSE(cost.is_known);
    }
    for (const CostEstimate& cost : estimate_costs(ground.until({}), strategies, 32, 1e9)) {
        EXPECT_TRUE(cost.is_affordable);
        EXPECT_TRUE(cost.is_known);
    }
}

TEST(KeepAffordable, KeepsTheCheapestThatFitTogetherAndAlwaysOne)
{
    std::vector<CostEstimate> costs{{4, true}, {1, true}, {2, true}, {0.5, false}};
    keep_affordable(costs, 3.5);
    EXPECT_FALSE(costs[0].is_affordable);
    EXPECT_TRUE(costs[1].is_affordable);
    EXPECT_TRUE(costs[2].is_affordable);
    EXPECT_FALSE(costs[3].is_affordable);  // it was not before
    keep_affordable(costs, 0);
    EXPECT_TRUE(costs[1].is_affordable);
    EXPECT_FALSE(costs[2].is_affordable);
}

TEST(Stopping, ARoundThatWasStoppedDoesNotCount)
{
    StoppableGround ground(stacked_scene(20));
    StrategyRun run(ground.lit, ground.points, parse_strategy("uniform/power"), 1);
    const auto round = [&](const StopToken& stop) {
        return run.sample_round({{1000}, 0, 2, 2, true}, {}, ground.workspaces, one_thread, stop);
    };
    Asks some{.most = 3};
    EXPECT_FALSE(round(some.token()));
    EXPECT_EQ(run.samples(), 0U);
    EXPECT_EQ(run.results()[0].luminance.count, 0U);  // as if it had never begun
    EXPECT_TRUE(round({}));
    EXPECT_EQ(run.samples(), 2000U);
    some.count = 0;
    EXPECT_FALSE(round(some.token()));
    EXPECT_EQ(run.samples(), 2000U);
    EXPECT_GE(run.results()[0].luminance.count, 2000U);
}

TEST(Rounds, AreTimedForThoseThatDoNotRest)
{
    StoppableGround stoppable(stacked_scene(3));
    std::vector<std::unique_ptr<StrategyRun>> runs;
    for (const char* name : {"uniform/power", "power/light"})
        runs.push_back(std::make_unique<StrategyRun>(stoppable.lit, stoppable.points,
                                                     parse_strategy(name), 1));
    const StudyGround ground = stoppable.until({});
    StudyRounds rounds(ground, runs, [](std::size_t, double) {});
    RoundOptions how{.tile_factors = std::vector(stoppable.points.shading.tiles.size(), 1.0),
                     .rests = {false, false}};
    const SamplePlan plan{.replicates = 2};
    rounds.take(2, plan, how);
    how.rests = {false, true};
    rounds.take(2, plan, how);
    const std::vector<double> ones(stoppable.points.shading.points.size(), 1.0);
    const RelativeScale scale{0, ones, ones, {}};
    const auto times_of = [&](int s) { return runs[s]->measurements(scale).times; };
    rounds.take(2, plan, how);
    ASSERT_EQ(times_of(0).size(), 3U);
    ASSERT_EQ(times_of(1).size(), 1U);
    EXPECT_EQ(times_of(0)[0].round, times_of(1)[0].round);
    EXPECT_LT(times_of(0)[1].round, times_of(0)[2].round);
    how.apart = {{.observations = 1, .parts = 2}, {.observations = 1}};
    how.rests = {false, false};
    rounds.take(2, plan, how);
    ASSERT_EQ(times_of(0).size(), 5U);  // each part of the tiles by itself
    EXPECT_GE(times_of(0)[3].round, of_no_round);
    ASSERT_EQ(times_of(1).size(), 2U);
    EXPECT_EQ(times_of(1)[1].round, times_of(0)[2].round + 1);
}

TEST(Stopping, AStudyReportsWhatItHasAndThatItIsPartial)
{
    std::atomic<bool> stop{false};
    const Scene scene = stacked_scene(20);
    const LitScene lit(scene, nullptr, called_for(scene));
    const Study study = run_study(
        lit, strategies_called({"uniform/power", "power/power"}),
        {.spp = 4096, .stop = &stop, .progress = [&](double, const SceneReport&) { stop = true; }},
        one_thread);
    EXPECT_TRUE(study.report.partial);
    const std::uint64_t a = study.report.strategies[0].samples,
                        b = study.report.strategies[1].samples;
    EXPECT_GT(a + b, 0U);
    EXPECT_EQ(std::min(a, b), 0U);
}

TEST(Stopping, AStudyWithoutTimeForItsPointsSaysSo)
{
    const Scene scene = stacked_scene(20);
    const LitScene lit(scene, nullptr, called_for(scene));
    EXPECT_THROW(
        run_study(lit, strategies_called({"uniform/power"}), {.seconds = 1e-9}, one_thread),
        Stopped);
}

TEST(LitScene, MakesAPolicysTablesOnceForAllStrategies)
{
    const Scene scene = stacked_scene(20);
    const LitScene lit(scene, nullptr, called_for(scene));
    EXPECT_EQ(lit.policy("tree"), lit.policy("tree"));
    EXPECT_EQ(lit.policy_in_order("tree"), lit.policy_in_order("tree"));
    EXPECT_NE(lit.policy("tree"), lit.policy_in_order("tree"));
    EXPECT_EQ(lit.order(), lit.order());
}

}  // namespace
}  // namespace mis
