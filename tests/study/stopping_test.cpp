#include "mis/study/stopping.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

StrategyReport ranked(double low, double high)
{
    StrategyReport s;
    s.status = Status::ranked;
    s.variance = {1, low, high};
    return s;
}

/// Would be resolved after so many times the samples that it has.
StrategyReport not_resolved(double factor)
{
    StrategyReport s;
    s.status = Status::not_resolved;
    s.resolving_factor = factor;
    return s;
}

SceneReport found(const std::vector<StrategyReport>& strategies, bool settled = true)
{
    SceneReport scene;
    scene.strategies = strategies;
    scene.settled = settled;
    return scene;
}

constexpr StudyGoal until_settled{};

TEST(Stopping, EndsOnceItIsSettledAndNobodyIsWorthWaitingFor)
{
    EXPECT_TRUE(is_enough(found({ranked(0.9, 1.1)}), until_settled, 1));
    EXPECT_FALSE(is_enough(found({ranked(0.9, 1.1)}, false), until_settled, 29));
    const SceneReport waiting = found({ranked(0.9, 1.1), not_resolved(4)});
    EXPECT_FALSE(is_enough(waiting, until_settled, 4));  // 1.5 · 4 · 4 s are below the 30 s
    EXPECT_TRUE(is_enough(waiting, until_settled, 6));   // and 1.5 · 4 · 6 s are past them
}

TEST(Stopping, GoesOnForAllOfATimeOrANumberOfSamples)
{
    EXPECT_FALSE(is_enough(found({ranked(0.9, 1.1)}), {.seconds = 10}, 9));
    EXPECT_FALSE(is_enough(found({ranked(0.9, 1.1)}), {.spp = 64}, 1e6));
    EXPECT_EQ((StudyGoal{.seconds = 10}).budget(), 10);
    EXPECT_EQ(until_settled.budget(), 30);
}

TEST(Stopping, WithAnErrorWaitsForEveryRankedVariance)
{
    const StudyGoal within_10_percent{.error = 0.1};
    EXPECT_TRUE(is_enough(found({ranked(0.91, 1.09)}, false), within_10_percent, 1));
    EXPECT_FALSE(is_enough(found({ranked(0.91, 1.09), ranked(0.8, 1.2)}), within_10_percent, 1e5));
    // Where none is ranked it would go on without end.
    EXPECT_FALSE(is_enough(found({not_resolved(1e9)}), within_10_percent, 29));
    EXPECT_TRUE(is_enough(found({not_resolved(1e9)}), within_10_percent, 31));
}

/// The ends of its variance's interval, and whether it may be best.
StrategyReport standing(double low, double high, bool may_be_best)
{
    StrategyReport s = ranked(low, high);
    s.may_be_best = may_be_best;
    return s;
}

TEST(Stopping, RestsWhatCannotWinOnceItsVarianceIsKnown)
{
    SceneReport scene = found({standing(0.9, 1.1, true), standing(0.9, 1.1, true),
                               standing(0.9, 1.1, false), standing(0.6, 1.6, false)},
                              false);
    EXPECT_EQ(resting(scene, until_settled, 5), (std::vector<bool>{false, false, true, false}));
    scene.decided = true;
    EXPECT_EQ(resting(scene, until_settled, 5), (std::vector<bool>{true, true, true, false}));
    scene.strategies[0].variance = {1, 0.74, 1.3};  // ± 28 %
    EXPECT_EQ(resting(scene, until_settled, 5), (std::vector<bool>{false, true, true, false}));
}

TEST(Stopping, RestsNobodyWhereNobodyIsNeeded)
{
    SceneReport scene = found({standing(0.9, 1.1, true), standing(0.9, 1.1, false)});
    scene.decided = true;
    EXPECT_EQ(resting(scene, until_settled, 5), (std::vector<bool>{false, false}));
}

TEST(Stopping, LetsThoseGoOnThatMayYetBeResolved)
{
    SceneReport scene = found({standing(0.9, 1.1, true), not_resolved(2), not_resolved(1000)});
    scene.decided = true;
    EXPECT_EQ(resting(scene, until_settled, 5), (std::vector<bool>{true, false, true}));
    EXPECT_EQ(resting(scene, until_settled, 20), (std::vector<bool>{false, false, false}));
}

}  // namespace
}  // namespace mis
