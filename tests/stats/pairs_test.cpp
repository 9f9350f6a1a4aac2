#include "mis/stats/pairs.h"

#include "mis/math/limits.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

Verdict verdict_of(LogEstimate log_ratio, double margin = 0.02)
{
    std::vector<Comparison> family{{0, 1, log_ratio}};
    decide(family, margin, 0.05);
    return family[0].verdict;
}

TEST(Decide, CallsAFarRatioApart) { EXPECT_EQ(verdict_of({0.5, 0.05, 15}), Verdict::apart); }
TEST(Decide, CallsAnUnsureRatioUndecided)
{
    EXPECT_EQ(verdict_of({0.05, 0.05, 15}), Verdict::undecided);
}
TEST(Decide, CallsARatioSurelyWithinTheMarginTied)
{
    EXPECT_EQ(verdict_of({0.001, 0.002, 15}), Verdict::tied);
}
TEST(Decide, CallsARatioWithinTheMarginTiedEvenIfItIsSurelyNotOne)
{
    EXPECT_EQ(verdict_of({0.01, 1e-4, 15}), Verdict::tied);
}
TEST(Decide, CallsARatioBeyondTheMarginApartHoweverSmall)
{
    EXPECT_EQ(verdict_of({0.025, 1e-4, 15}), Verdict::apart);
}
TEST(Decide, CallsEqualFiguresTied) { EXPECT_EQ(verdict_of({0, 0, 15}), Verdict::tied); }
TEST(Decide, CallsExactAndInexactApart)
{
    EXPECT_EQ(verdict_of({-infinity, 0, 1}), Verdict::apart);
}
TEST(Decide, LeavesTheUnknownUndecided)
{
    EXPECT_EQ(verdict_of({0.5, std::nan(""), 1}), Verdict::undecided);
}

TEST(Decide, CorrectsForTheSizeOfTheFamily)
{
    // p = 0.01: significant alone, not among 10; with p = 1e-4 beside it, Holm's second step is
    // 0.05/9.
    const double t_of_1_percent = t_quantile(0.005, 15), t_of_half_percent = t_quantile(0.0025, 15);
    std::vector<Comparison> family(10, Comparison{0, 1, {0.02, 1, 15}});
    family[3].log_ratio.value = t_of_1_percent;
    decide(family, 0.02, 0.05);
    EXPECT_EQ(family[3].verdict, Verdict::undecided);
    family[3].log_ratio.value = t_of_half_percent * 1.02;  // p just below 0.05/10
    family[7].log_ratio.value = t_quantile(0.0026, 15);    // p just below 0.05/9
    decide(family, 0.02, 0.05);
    EXPECT_EQ(family[3].verdict, Verdict::apart);
    EXPECT_EQ(family[7].verdict, Verdict::apart);
    EXPECT_EQ(verdict_of({t_of_1_percent, 1, 15}), Verdict::apart);
}

TEST(ReplicatesToDecide, AreAsManyAsDecide)
{
    for (const double distance : {0.0, 0.005, 0.012, 0.05, 0.3}) {
        Comparison c{0, 1, {distance, 0.1, 15}};
        const double more = replicates_to_decide(c, 10, 16, 0.02, 0.05);
        ASSERT_GT(more, 0);
        std::vector<Comparison> family(10, c);
        for (Comparison& each : family)
            each.log_ratio = {distance, 0.1 * std::sqrt(16 / (16 + more)), 15 + more};
        decide(family, 0.02, 0.05);
        EXPECT_NE(family[0].verdict, Verdict::undecided) << distance;
        if (more < 20) continue;  // rounded up to whole replicates
        for (Comparison& each : family) each.log_ratio.se = 0.1 * std::sqrt(16 / (16 + 0.9 * more));
        decide(family, 0.02, 0.05);
        EXPECT_EQ(family[0].verdict, Verdict::undecided) << distance;
    }
}

TEST(ReplicatesToDecide, IsFiniteFromTwoReplicates)
{
    const Comparison c{0, 1, {0.1, 0.5, 1}};
    EXPECT_LT(replicates_to_decide(c, 136, 2, 0.02, 0.05), 1e4);
}

TEST(RankIntervals, CountTheSurelyBetterAndTheSurelyWorse)
{
    // 0 < 1 ~ 2 < 3, by variance; 4 is no member.
    std::vector<Comparison> family{
        {0, 1, {-1, .1, 9}, Verdict::apart}, {0, 2, {-1, .1, 9}, Verdict::apart},
        {0, 3, {-2, .1, 9}, Verdict::apart}, {1, 2, {-.01, .1, 9}, Verdict::undecided},
        {1, 3, {-1, .1, 9}, Verdict::apart}, {3, 2, {1, .1, 9}, Verdict::apart}};
    const std::vector<int> members{0, 1, 2, 3};
    const auto ranks = rank_intervals(family, members, 5);
    EXPECT_EQ(ranks[0].high, 1);
    EXPECT_EQ(ranks[1].low, 2);
    EXPECT_EQ(ranks[1].high, 3);
    EXPECT_EQ(ranks[2].low, 2);
    EXPECT_EQ(ranks[2].high, 3);
    EXPECT_EQ(ranks[3].low, 4);
    EXPECT_EQ(ranks[4].high, 0);
}

}  // namespace
}  // namespace mis
