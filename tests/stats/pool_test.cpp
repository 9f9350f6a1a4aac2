#include "mis/stats/pool.h"

#include "mis/math/stable.h"
#include "mis/stats/estimate.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

Moments moments_of(const std::vector<double>& samples)
{
    return Moments::of(std::span<const double>(samples));
}

TEST(Pool, AveragesVariancesOverPoints)
{
    const std::vector<Moments> points{moments_of({0, 2}), moments_of({1, 1, 4})};
    const PooledFigures pooled = pool_points(points, std::vector<double>{2, 6});
    EXPECT_EQ(pooled.samples, 5u);
    EXPECT_DOUBLE_EQ(pooled.mean, 1.5);
    EXPECT_DOUBLE_EQ(pooled.variance, (2 + 3) / 2.0);
    EXPECT_DOUBLE_EQ(pooled.relative_variance, (2 / 2.0 + 3 / 6.0) / 2);
    EXPECT_DOUBLE_EQ(pooled.largest_point_share, 3 / 5.0);
}

TEST(Pool, CountsTheSamplesThatCarryTheVariance)
{
    std::vector<double> rare(1000, 0.0);
    rare[17] = 1;
    const std::vector<Moments> points(25, moments_of(rare));
    const std::vector<double> scale(25, 1.0);
    EXPECT_NEAR(pool_points(points, scale).participation.number(), 25, 0.2);
    EXPECT_NEAR(participation_of(points).number(), 25, 0.2);
    EXPECT_DOUBLE_EQ(pool_points(points, scale).rare_share, 1);
    const std::vector<Moments> even(25, moments_of({-1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1}));
    EXPECT_NEAR(pool_points(even, scale).participation.number(), 300, 1e-9);
    EXPECT_EQ(pool_points(even, scale).rare_share, 0);
}

TEST(Pool, HasNoRelativeVarianceWhereTheMeanIsZeroAndTheVarianceIsNot)
{
    const std::vector<double> zero{0.0};
    EXPECT_EQ(pool_points(std::vector{moments_of({0, 0})}, zero).relative_variance, 0);
    EXPECT_TRUE(std::isinf(pool_points(std::vector{moments_of({-1, 1})}, zero).relative_variance));
}

TEST(Pool, LeavesPointsWithOneSampleOutOfTheVariance)
{
    const PooledFigures pooled =
        pool_points(std::vector{moments_of({5}), moments_of({0, 2})}, std::vector<double>{1, 1});
    EXPECT_DOUBLE_EQ(pooled.variance, 2);
    EXPECT_DOUBLE_EQ(pooled.mean, 3);
}

/// Points that a sample in five reaches; their relative variance is 4.
struct RarelyReached {
    std::vector<Moments> points;
    RelativeScale scale;

    explicit RarelyReached(int samples)
    {
        Uniforms uniforms(31);
        for (int p = 0; p < 4000; ++p) {
            Moments point;
            for (int i = 0; i < samples; ++i) point.add(uniforms() < 0.2 ? 5 : 0);
            points.push_back(point);
            scale.means.push_back(point.mean);
            scale.squares.push_back(square(point.mean));
            scale.mean_errors.push_back(point.mean_se());
        }
    }
    double found() const { return pool_points(points, scale.squares).relative_variance; }
};

TEST(Pool, TheDoubtOfARelativeVarianceHoldsTheTruth)
{
    const RarelyReached few(64), many(256);
    const double doubt = relative_variance_doubt(few.points, few.scale);
    EXPECT_GT(std::abs(few.found() - 4), 0.1);  // some 4/13, and noise below 0.03
    EXPECT_LT(std::abs(few.found() - 4), doubt);
    EXPECT_LT(doubt, 2);
    EXPECT_NEAR(relative_variance_doubt(many.points, many.scale) / doubt, 0.2, 0.06);
}

TEST(Pool, OfAnExactScaleThereIsNoDoubt)
{
    RarelyReached few(64);
    few.scale.mean_errors.clear();
    EXPECT_EQ(relative_variance_doubt(few.points, few.scale), 0);
}

TEST(Pool, AnotherHalfWidthWidensAnIntervalLikeAnIndependentError)
{
    const Interval interval{2, 2 * std::exp(-0.3), 2 * std::exp(0.3)};
    EXPECT_NEAR(std::log(widened(interval, 0.4).high / 2), 0.5, 1e-12);
    EXPECT_NEAR(std::log(widened(interval, 0.4).low / 2), -0.5, 1e-12);
    EXPECT_EQ(widened(interval, 0).high, interval.high);
    EXPECT_TRUE(std::isnan(widened(unknown_interval(), 0.4).high));
}

}  // namespace
}  // namespace mis
