#include "mis/stats/at_counts.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

/// A strategy of that relative variance, known to ± share, with a second for a sample and four for
/// a point.
StrategyReport ranked_with(double relative_variance, double share)
{
    StrategyReport s;
    s.status = Status::ranked;
    const auto about = [&](double x) { return Interval{x, x / (1 + share), x * (1 + share)}; };
    s.variance = about(3 * relative_variance);
    s.relative_variance = about(relative_variance);
    s.seconds_per_sample = about(1);
    s.seconds_per_point = about(4);
    s.efficiency = about(0.123);
    return s;
}

TEST(AtCounts, AreTheOneVarianceWithItsPartOfThePoint)
{
    const StrategyReport s = ranked_with(0.5, 0.1);
    const CountFigures c = at_count(s, 16, 64);
    EXPECT_EQ(c.n, 64);
    EXPECT_EQ(c.status, Status::ranked);
    EXPECT_EQ(c.variance.value, 1.5);
    EXPECT_DOUBLE_EQ(c.seconds_per_sample.value, 1 + 4.0 / 64);
    EXPECT_DOUBLE_EQ(c.seconds_per_sample.high, 1.1 * (1 + 4.0 / 64));
    EXPECT_DOUBLE_EQ(c.efficiency.value, 1 / (1.5 * (1 + 4.0 / 64)));
    // Two factors, each known to 10 %.
    EXPECT_NEAR(std::log(c.efficiency.high / c.efficiency.value), std::sqrt(2) * std::log(1.1),
                1e-12);
    EXPECT_DOUBLE_EQ(c.relative_error.value, std::sqrt(0.5 / 64));
    EXPECT_DOUBLE_EQ(c.relative_error.high, std::sqrt(0.55 / 64));
    EXPECT_EQ(at_count(s, 16, 16).efficiency.value, 0.123);  // as it was ranked
}

TEST(AtCounts, NameAnotherOnlyWhereItIsSurelyBest)
{
    const auto found = [](double leader, double other, double share) {
        SceneReport scene;
        for (const double v : {leader, other}) {
            scene.strategies.push_back(ranked_with(1, share));
            scene.strategies.back().at_counts = {at_count(scene.strategies.back(), 16, 16),
                                                 at_count(ranked_with(v, share), 256, 256)};
        }
        EXPECT_FALSE(best_at_count(scene, 0, 0));
        return best_at_count(scene, 0, 1);
    };
    const auto sure = found(1, 0.5, 0.05);
    ASSERT_TRUE(sure);
    EXPECT_EQ(sure->best, 1);
    EXPECT_NEAR(sure->sooner.value, 2, 1e-12);
    // Four factors known to 5 % each: half width of the logarithm 0.098, and of twice that 0.195.
    EXPECT_NEAR(sure->sooner.low, 2 * std::exp(-2 * std::log(1.05)), 1e-12);
    EXPECT_FALSE(found(1, 1 / 1.2, 0.05));
    EXPECT_TRUE(found(1, 1 / 1.23, 0.05));
    EXPECT_FALSE(found(1, 0.5, 0.3));
    EXPECT_FALSE(found(0.5, 1, 0.05));
}

TEST(AtCounts, OfUnknownErrorsNameNothing)
{
    SceneReport scene;
    for (const double v : {1.0, 0.1}) {
        StrategyReport s = ranked_with(v, 0.01);
        s.relative_variance.low = s.relative_variance.high = std::nan("");
        s.at_counts = {at_count(s, 16, 16), at_count(s, 16, 64)};
        scene.strategies.push_back(s);
    }
    EXPECT_FALSE(best_at_count(scene, 0, 1));
    scene.strategies[0].at_counts[1].status = Status::not_run;
    EXPECT_FALSE(best_at_count(scene, 0, 1));
}

}  // namespace
}  // namespace mis
