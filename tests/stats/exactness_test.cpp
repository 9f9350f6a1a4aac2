#include "mis/stats/exactness.h"

#include "mis/stats/resolved.h"

#include "tests/support/simulated.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// Samples of one value, but for rounding.
SampleOf rounded(double value)
{
    return [value](Random& bits) {
        return value * (1 + std::uniform_real_distribution<double>(-1e-7, 1e-7)(bits));
    };
}

StrategyMeasurements looked_at(StrategyMeasurements s)
{
    s.audit.available = true;
    s.all_samples_equal_reference = exactness_of(s) != Exactness::none;
    return s;
}

StrategyMeasurements proved(StrategyMeasurements s)
{
    s.is_proved_exact = true;
    s.all_samples_equal_reference = exactness_of(s) != Exactness::none;
    return s;
}

TEST(Exactness, IsOfSamplesThatDifferByRoundingAlone)
{
    for (const std::size_t samples : {2, 16, 256}) {
        const Simulation sim{.samples = samples};
        EXPECT_EQ(exactness_of(looked_at(simulate("a", rounded(1), sim))), Exactness::by_samples);
        EXPECT_EQ(exactness_of(looked_at(simulate("a", uniform_samples(1e-10), sim))),
                  Exactness::none);
    }
}

/// What nobody else has looked at may hide samples that were never drawn; `all` hides none.
TEST(Exactness, TakesMoreThanAStrategysOwnWord)
{
    StrategyMeasurements s = simulate("power", rounded(1));
    EXPECT_EQ(exactness_of(s), Exactness::none);
    EXPECT_EQ(std::get<reason::RoundingAlone>(why_not_resolved(s)).zero_points, 0U);
    s.strategy = named("all");
    EXPECT_EQ(exactness_of(s), Exactness::by_samples);
}

TEST(Exactness, IsNotOfPointsThatWereBlackInAllSamples)
{
    int point = 0;
    const Simulation sim;
    const StrategyMeasurements s = looked_at(simulate("a", [&](Random& bits) {
        return point++ / static_cast<int>(sim.samples) % 64 == 7 ? 0 : rounded(1)(bits);
    }));
    ASSERT_EQ(s.pooled.zero_points, 1U);
    EXPECT_EQ(exactness_of(s), Exactness::none);
    EXPECT_EQ(std::get<reason::RoundingAlone>(why_not_resolved(s)).zero_points, 1U);
    EXPECT_EQ(exactness_of(proved(s)), Exactness::by_proof);
}

/// One sample in sixteen thousand that is off by a thousandth: the mean over the points is
/// rounding, that point is not.
TEST(Exactness, IsNotWhereOneSampleIsOff)
{
    int left = 5000;
    const StrategyMeasurements s = looked_at(
        simulate("a", [&](Random& bits) { return left-- == 0 ? 1.001 : rounded(1)(bits); }));
    EXPECT_EQ(exactness_of(s), Exactness::none);
    EXPECT_GT(s.pooled.largest_relative_variance, 1e-9);
}

/// An estimate has a false alarm now and then; a theorem has none.
TEST(Exactness, ByProofIsNotRefutedByTheAuditButByItsOwnSamples)
{
    const auto accused = [](StrategyMeasurements s) {
        s.audit = {
            .available = true, .variance_from_others = 6e-5, .variance_from_others_se = 1e-7};
        return s;
    };
    EXPECT_TRUE(is_none(why_not_resolved(accused(proved(simulate("a", rounded(1)))))));
    EXPECT_FALSE(is_none(why_not_resolved(accused(looked_at(simulate("a", rounded(1)))))));
    const StrategyMeasurements leaks =
        proved(simulate("a", rare_samples(1 - 1e-3)));  // a draw in a thousand is lost
    EXPECT_EQ(exactness_of(leaks), Exactness::none);
}

/// No variance of rounding is a figure, however many samples there are.
TEST(Exactness, WhatIsRoundingIsNeverRankedByItsVariance)
{
    for (const std::size_t samples : {2, 16, 256, 2048}) {
        const StrategyMeasurements s = simulate("a", rounded(1), {.samples = samples});
        ASSERT_LT(s.pooled.variance, 1e-13);
        EXPECT_FALSE(is_none(why_not_resolved(s)));
    }
}

}  // namespace
}  // namespace mis
