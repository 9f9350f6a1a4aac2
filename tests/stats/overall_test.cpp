#include "mis/stats/overall.h"

#include "mis/stats/rank.h"
#include "mis/words/verdict.h"
#include "tests/support/simulated.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

SceneReport scene_with(std::vector<StrategyMeasurements> strategies)
{
    Ranking ranking = rank({.points = 64, .strategies = std::move(strategies)}, {});
    SceneReport scene;
    put_ranking(std::move(ranking), 1, scene);
    return scene;
}

SceneReport bright()
{
    return scene_with({simulate("a", uniform_samples(0.1)), simulate("b", uniform_samples(0.2)),
                       simulate("c", uniform_samples(0.3))});
}
SceneReport dark()
{
    return scene_with({simulate("a", uniform_samples(0.08)), simulate("b", uniform_samples(0.01)),
                       simulate("c", rare_samples(1e-4))});
}

TEST(Overall, IsTheGeometricMeanOfTheRatiosToTheBestOfEachScene)
{
    const auto overall = rank_overall({bright(), dark()});
    ASSERT_EQ(overall.size(), 2u);  // c is not ranked on the second
    EXPECT_EQ(overall[0].name, "b/power");
    EXPECT_NEAR(overall[0].variance_ratio.value, std::sqrt(2.0 * 1), 0.05);
    EXPECT_NEAR(overall[1].variance_ratio.value, std::sqrt(1.0 * 8), 0.1);
    EXPECT_LT(overall[1].variance_ratio.low, overall[1].variance_ratio.value);
    EXPECT_EQ(overall[0].rank, 1);
    EXPECT_EQ(overall[1].rank, 2);
    EXPECT_EQ(overall[0].rank_by_efficiency, 1);
    EXPECT_NEAR(overall[0].time_ratio.value, std::sqrt(2.0), 0.1);
}

TEST(Overall, PutsThoseLastThatOthersBeatWithoutAnyVariance)
{
    const SceneReport solved =
        scene_with({simulate_exact("a"), simulate("b", uniform_samples(0.2))});
    const auto overall = rank_overall({solved, dark()});
    ASSERT_EQ(overall.size(), 2u);
    EXPECT_EQ(overall[0].name, "a/power");
    EXPECT_EQ(overall[1].beaten_by_exact, 1);
    for (const OverallReport& o : overall)
        EXPECT_TRUE(std::isfinite(o.variance_ratio.value) && std::isfinite(o.cost_ratio.value));
}

TEST(Overall, TakesSeveralScenes)
{
    EXPECT_TRUE(rank_overall({bright()}).empty());
    EXPECT_TRUE(rank_overall({bright(), {}}).empty());
}

TEST(Overall, IsSaidInASentence)
{
    Report report;
    report.scenes = {bright(), dark()};
    report.overall = rank_overall(report.scenes);
    EXPECT_EQ(overall_sentences_of(report)[0].find("Over all 2 scenes use b/power"), 0u);
    report.overall.clear();
    EXPECT_NE(overall_sentences_of(report)[0].find("No strategy was ranked on all scenes"),
              std::string::npos);
}

}  // namespace
}  // namespace mis
