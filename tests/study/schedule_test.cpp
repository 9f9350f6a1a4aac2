#include "mis/study/schedule.h"

#include "mis/stats/rank.h"

#include "tests/support/simulated.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

TEST(ErrorSpending, SpendsLittleEarlyAndNeverMoreThanAll)
{
    ErrorSpending spending;
    double spent = 0;
    for (const double elapsed : {0.1, 0.3, 0.3, 0.7, 1.2}) {
        const double share = spending.spend_at(elapsed);
        EXPECT_GE(share, 0);
        spent += share;
        EXPECT_LE(spent, 0.5 * std::min(1.0, elapsed * elapsed) + 1e-15);
    }
    EXPECT_DOUBLE_EQ(spent + spending.spend_rest(), 1);
    EXPECT_EQ(spending.spend_rest(), 0);
}

TEST(Parts, AreMoreWhereRoundsAreFewAndDivideTheReplicates)
{
    EXPECT_EQ(parts_for(1, 60), 1);
    EXPECT_EQ(parts_for(1, 4), 2);
    EXPECT_EQ(parts_for(1, 1), 4);
    for (const double seconds : {0.1, 1.0, 2.0, 2.3, 3.0, 6.0, 100.0})
        EXPECT_EQ(SamplePlan{}.replicates % parts_for(1, seconds), 0) << seconds;
}

TEST(Schedule, TimesEachOfTheFirstRoundsThenAsManyInEachDoubling)
{
    std::uint32_t timed = 0;
    for (std::uint32_t round = 0; round < 1024; ++round) timed += is_round_timed(round);
    EXPECT_EQ(timed, 1024U);
    for (std::uint32_t from = 1024; from < 1U << 20; from *= 2) {
        timed = 0;
        for (std::uint32_t round = from; round < 2 * from; ++round) timed += is_round_timed(round);
        EXPECT_EQ(timed, 512U) << from;
    }
}

/// A verdict stands at a look that may spend almost nothing; but not for the one that is no longer
/// the better.
TEST(Rank, LetsEarlierVerdictsStand)
{
    const StrategyMeasurements a = simulate("a", uniform_samples(0.1)),
                               b = simulate("b", uniform_samples(0.105));
    const SceneMeasurements scene{64, {a, b}};
    SceneReport earlier;
    put_ranking(rank(scene, {}), 1, earlier);
    ASSERT_EQ(earlier.pairs[0].verdict, Verdict::apart);
    EXPECT_EQ(rank(scene, {.share = 1e-6}).pairs[0].verdict, Verdict::undecided);
    EXPECT_EQ(rank(scene, {.share = 1e-6, .earlier = &earlier}).pairs[0].verdict, Verdict::apart);
    SceneReport turned = earlier;
    std::swap(turned.pairs[0].a, turned.pairs[0].b);
    EXPECT_EQ(rank(scene, {.share = 1e-6, .earlier = &turned}).pairs[0].verdict,
              Verdict::undecided);
}

}  // namespace
}  // namespace mis
