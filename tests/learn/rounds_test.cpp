#include "mis/learn/rounds.h"
#include "mis/learn/seen_counts.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

TEST(LearningRounds, TakeAllDrawsAndWeighOne)
{
    for (int draws = 1; draws < 3000; ++draws) {
        int taken = 0;
        double weight = 0;
        for (const LearningRound& round : learning_rounds(draws)) {
            EXPECT_GT(round.draws, 0);
            EXPECT_GT(round.weight, 0);
            taken += round.draws, weight += round.weight;
        }
        ASSERT_EQ(taken, draws);
        ASSERT_NEAR(weight, 1, 1e-12);
    }
}

TEST(LearningRounds, GrowFourfoldAndTheLastHasThreeQuarters)
{
    const std::vector<LearningRound> rounds = learning_rounds(256);
    ASSERT_EQ(rounds.size(), 4u);
    EXPECT_EQ(rounds[0].draws, 4);
    EXPECT_EQ(rounds[1].draws, 12);
    EXPECT_EQ(rounds[2].draws, 48);
    EXPECT_EQ(rounds[3].draws, 192);
    EXPECT_NEAR(rounds[3].weight, 1 - 0.125, 1e-12);  // (64/256)^1.5
    for (const int few : {1, 3, 15}) EXPECT_EQ(learning_rounds(few).size(), 1u) << few;
    EXPECT_EQ(learning_rounds(16).size(), 2u);
}

TEST(SeenCounts, GiveAMeanBetweenWhatWasSeenAndThePriorAndNever0)
{
    EXPECT_EQ(seen_in_tile(0.0, 0.0), 1);
    EXPECT_EQ(seen_within(0.0, 0.0, 0.25), 0.25);
    EXPECT_NEAR(seen_within(3.0, 8.0, 0.5), 0.4, 1e-12);  // (3 + 1)/(8 + 2)
    EXPECT_GT(seen_within(0.0, 1e6, seen_within(0.0, 1e6, seen_in_tile(0.0, 1e8))), 0);
    EXPECT_LE(seen_within(1e6, 1e6, 1.0), 1);
}

}  // namespace
}  // namespace mis
