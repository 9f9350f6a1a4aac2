#include "tests/cases/judge.h"

#include "tests/support/statistics.h"

#include <gtest/gtest.h>
#include <boost/math/distributions/gamma.hpp>

#include <cmath>

namespace mis {
namespace {

TEST(SkewedBound, IsTheNormalOneWhereNothingIsSkewed)
{
    for (const double p : {1e-3, 1e-8, 1e-12})
        EXPECT_NEAR(skewed_z_bound(p, 0), z_bound(2 * p, 1), 1e-9 * z_bound(2 * p, 1));
}

/// The sum of n exponential numbers has a gamma distribution; their kurtosis is 9.
TEST(SkewedBound, CoversTheTailOfExponentialNumbersAndANormalOneDoesNot)
{
    for (const double n : {900.0, 9000.0}) {
        const boost::math::gamma_distribution<> sum(n, 1);
        const auto tail = [&](double z) {
            return boost::math::cdf(complement(sum, n + z * std::sqrt(n)));
        };
        constexpr double p = 1e-11;
        EXPECT_LT(tail(skewed_z_bound(p, 9 / n)), p);
        EXPECT_GT(tail(skewed_z_bound(p, 0)), 2 * p);
    }
}

/// n numbers of mean 1 and variance `variance`, as many above as below.
Moments two_values(double n, double mean, double variance)
{
    return {.count = static_cast<std::uint64_t>(n),
            .mean = mean,
            .m2 = n * variance,
            .m4 = n * variance * variance};
}

constexpr Strictness usual_strictness{1e-9, 1e-6};

TEST(Disagreement, IsFoundInAMeanADeviationAndWhatIsNoNumber)
{
    const Predicted p{.mean = 1, .variance = 0.01, .fourth = 1e-4};
    constexpr double n = 1e4;
    EXPECT_EQ(disagreement(two_values(n, 1, 0.01), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(n, 1.01, 0.01), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(n, 0.99, 0.01), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(n, 1, 0.0103), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(n, 1, 0.0097), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(n, std::nan(""), 0.01), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(n, 1, std::nan("")), p, usual_strictness), "");
}

TEST(Disagreement, OfAConstantIsMoreThanRounding)
{
    const Predicted p{.mean = 1, .variance = 0, .variance_error = 1e-20};
    EXPECT_EQ(disagreement(two_values(100, 1 + 1e-6, 1e-13), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(100, 1 + 3e-6, 1e-13), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(100, 1, 1e-10), p, usual_strictness), "");
    const Predicted unknown{.mean = 1, .variance = 0, .variance_error = 1e-3};
    EXPECT_NE(disagreement(two_values(100, 1, 0), unknown, usual_strictness), "");
}

TEST(Disagreement, OfRareSamplesIsFoundByWhatHoldsForAnyDistribution)
{
    // One of 1e6 counts, and is worth 1e6.
    const Predicted p{.mean = 1, .variance = 1e6, .fourth = 1e18};
    EXPECT_EQ(disagreement(two_values(1e4, 0, 0), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(1e8, 0, 0), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(1e4, 1e6, 0), p, usual_strictness), "");
    EXPECT_NE(disagreement(two_values(1e4, -1e3, 0), p, usual_strictness), "");
}

}  // namespace
}  // namespace mis
