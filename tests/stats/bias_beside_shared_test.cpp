// Own means beside the mean of shared directions.
#include "mis/stats/bias.h"

#include "tests/support/simulated.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mis {
namespace {

constexpr std::size_t regions_of_checks = 16;

/// An own mean that is off by `bias`, of errors 0.01 each; in one region alone if there is one.
StrategyMeasurements checked(Random& bits, double bias, int region = -1)
{
    std::normal_distribution<double> noise(0, 1);
    StrategyMeasurements s;
    s.shared.emplace();
    s.pooled.participation = {100, 1};
    s.region_participation.assign(regions_of_checks, {100, 1});
    for (int level = 0; level <= int(regions_of_checks); ++level) {
        MeanCheck check{.own_se = 0.01, .shared_se = 0.01, .shared_dof = 20};
        check.shared = 1 + 0.01 * noise(bits);
        check.own = 1 + 0.01 * noise(bits) + (region < 0 || region == level - 1 ? bias : 0);
        s.mean_checks.push_back(check);
    }
    return s;
}

BiasFinding beside_shared(const StrategyMeasurements& s, double error = 1e-3)
{
    const StrategyMeasurements* const only = &s;
    return find_bias_beside_shared(std::span(&only, 1), error).front();
}

// At 5 % an honest strategy is called biased in at most that many of 2000 runs; the bound is passed
// by chance once in 3 million.
TEST(BiasBesideShared, IsSeldomSeenWhereThereIsNone)
{
    Random bits(3);
    constexpr int runs = 2000;
    int biased = 0;
    for (int run = 0; run < runs; ++run) biased += beside_shared(checked(bits, 0), 0.05).biased;
    EXPECT_LT(biased / double(runs), rate_bound(0.05, runs));
    EXPECT_GT(biased, 0);
}

TEST(BiasBesideShared, IsSeenOverTheImageAndInARegion)
{
    Random bits(4);
    const BiasFinding high = beside_shared(checked(bits, 0.2)),
                      low = beside_shared(checked(bits, -0.2)),
                      local = beside_shared(checked(bits, -0.2, 5));
    EXPECT_TRUE(high.biased && !high.too_low);
    EXPECT_TRUE(low.biased && low.too_low);
    EXPECT_TRUE(local.biased && local.only_in_regions);
    EXPECT_EQ(local.why.region, 5);
    EXPECT_TRUE(local.why.beside_shared);
}

/// Rare samples that were not drawn leave the mean low; its error, by the true variance, knows.
TEST(BiasBesideShared, IsNotSeenWhereRareSamplesWereNotDrawn)
{
    Random bits(5);
    StrategyMeasurements s = checked(bits, 0);
    for (MeanCheck& check : s.mean_checks) check.own = 0.1, check.own_se = 0.5;
    EXPECT_FALSE(beside_shared(s).biased);
}

TEST(BiasBesideShared, IsNotSeenWhereOneBrightSampleWouldDo)
{
    Random bits(6);
    StrategyMeasurements s = checked(bits, 0.3);
    s.pooled.participation = {5, 5};
    s.region_participation.assign(regions_of_checks, {5, 5});
    EXPECT_FALSE(beside_shared(s).biased);
    s = checked(bits, 0.3);
    for (MeanCheck& check : s.mean_checks) check.is_testable = false;
    EXPECT_FALSE(beside_shared(s).biased);
}

TEST(BiasBesideShared, HasALeastThatIsSeen)
{
    Random bits(8);
    int seen = 0;
    constexpr int runs = 200;
    for (int run = 0; run < runs; ++run) {
        const StrategyMeasurements s = checked(bits, 0);
        const double least = least_detectable_bias(s, 1e-3, 1 + double(regions_of_checks));
        EXPECT_NEAR(least, 0.075, 0.02);
        seen += beside_shared(checked(bits, least)).biased;
    }
    EXPECT_GT(seen, 0.9 * runs);
}

TEST(BiasBesideShared, HasNoLeastWhereNothingIsChecked)
{
    EXPECT_TRUE(std::isnan(least_detectable_bias({}, 1e-3, 0)));
}

}  // namespace
}  // namespace mis
