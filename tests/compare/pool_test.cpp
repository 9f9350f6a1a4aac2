#include "mis/compare/pool.h"

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

}  // namespace
}  // namespace mis
