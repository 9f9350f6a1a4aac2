#include "mis/stats/decision.h"

#include "mis/math/limits.h"
#include "mis/stats/estimate.h"
#include "tests/support/simulated.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mis {
namespace {

constexpr double many = 1e6;  // degrees of freedom

/// All pairs of strategies whose logarithms are such, each known to ± se.
std::vector<Comparison> pairs_of(const std::vector<double>& logs, double se, double dof = many)
{
    std::vector<Comparison> pairs;
    for (int a = 0; a < static_cast<int>(logs.size()); ++a)
        for (int b = a + 1; b < static_cast<int>(logs.size()); ++b)
            pairs.push_back({a, b, {logs[a] - logs[b], se, dof}});
    return pairs;
}

std::vector<int> all_of(std::size_t count)
{
    std::vector<int> members(count);
    std::iota(members.begin(), members.end(), 0);
    return members;
}

Decision decided(const std::vector<double>& logs, double se, std::span<const Standing> earlier = {})
{
    const std::vector<Comparison> pairs = pairs_of(logs, se);
    const std::vector<int> members = all_of(logs.size());
    return decide_best({members, pairs, logs.size(), 0.05, earlier});
}

TEST(Decision, LeadsByTheLeastFigureAndExcludesWhatIsSurelyBehind)
{
    const Decision d = decided({0.3, 0, 0.04, 1}, 0.02);
    EXPECT_EQ(d.leader, 1);
    EXPECT_FALSE(d.of[0].may_be_best);
    EXPECT_TRUE(d.of[1].may_be_best);
    EXPECT_TRUE(d.of[2].may_be_best);  // 2 errors behind, where 2.13 are asked for
    EXPECT_FALSE(d.of[3].may_be_best);
}

/// Against either of k − 1 others at 5 %/(k − 1), one-sided: of three, the normal's 2.5 %.
TEST(Decision, BoundsHowFarEachMayBeBehindTheBest)
{
    const double room = t_quantile(0.025, many) * 0.02;
    const Decision d = decided({0, 0.01, 0.5}, 0.02);
    EXPECT_NEAR(d.of[0].behind_at_most, std::expm1(room - 0.01), 1e-12);
    EXPECT_NEAR(d.of[1].behind_at_most, std::expm1(room + 0.01), 1e-12);
    EXPECT_NEAR(d.of[2].behind_at_most, std::expm1(room + 0.5), 1e-12);
    EXPECT_TRUE(d.is_decided);
    EXPECT_EQ(d.more, 0);
    EXPECT_EQ(decided({0, 0.5}, 0.02).of[0].behind_at_most, 0);  // it is surely the best
}

TEST(Decision, IsMadeOnceTheLeaderIsAtMost5PercentBehind)
{
    EXPECT_TRUE(decided({0, 0}, 0.0296).is_decided);  // 1.645 · 0.0296 = log 1.05
    EXPECT_FALSE(decided({0, 0}, 0.0298).is_decided);
    EXPECT_TRUE(decided({0, 0.02}, 0.04).is_decided);
    EXPECT_FALSE(decided({}, 0.01).is_decided);
    EXPECT_TRUE(decided({7}, 0.01).is_decided);  // there is no other
}

TEST(Decision, SaysHowManyMoreSamplesWouldDecide)
{
    for (const double lead : {0.0, 0.03}) {
        const Decision d = decided({0, lead, 0.001, 5}, 0.1);
        ASSERT_FALSE(d.is_decided);
        EXPECT_TRUE(decided({0, lead, 0.001, 5}, 0.1 / std::sqrt(1.001 * (1 + d.more))).is_decided);
        EXPECT_FALSE(
            decided({0, lead, 0.001, 5}, 0.1 / std::sqrt(0.999 * (1 + d.more))).is_decided);
    }
}

TEST(Decision, ClaimsNothingWhereNoErrorIsKnown)
{
    const Decision d = decided({0, 1}, nan);
    EXPECT_FALSE(d.is_decided);
    EXPECT_TRUE(std::isnan(d.more));
    EXPECT_TRUE(d.of[0].may_be_best && d.of[1].may_be_best);
    EXPECT_TRUE(std::isinf(d.of[0].behind_at_most));
}

TEST(Decision, OfExactOnesIsForThem)
{
    std::vector<Comparison> pairs{{0, 1, {infinity, 0, 1}}};
    const Decision d = decide_best({all_of(2), pairs, 2});
    EXPECT_EQ(d.leader, 1);
    EXPECT_TRUE(d.is_decided);
    EXPECT_FALSE(d.of[0].may_be_best);
}

TEST(Decision, LetsStandWhatAnEarlierLookFound)
{
    const Decision first = decided({0, 0.1, 0.5}, 0.02);
    const Decision later = decided({0, 0.1, 0.5}, 0.2, first.of);
    EXPECT_TRUE(later.is_decided);
    EXPECT_FALSE(later.of[1].may_be_best);
    EXPECT_EQ(later.of[1].behind_at_most, first.of[1].behind_at_most);
    // All that could be best then cannot now: one look was wrong, and the later has seen more.
    const Decision turned = decided({1, 0}, 0.01, decided({0, 1}, 0.01).of);
    EXPECT_EQ(turned.leader, 1);
    EXPECT_GT(turned.of[0].behind_at_most, 1);
}

TEST(Decision, TakesTheFirstAskedForOfThoseThatAreAlike)
{
    const std::vector<double> logs{0.2, 0.03, 0.02, 0};
    const std::vector<Comparison> pairs = pairs_of(logs, 0.1);
    const std::vector<int> members = all_of(4);
    Contenders among{members, pairs, 4};
    EXPECT_EQ(decide_best(among).leader, 3);
    among.are_alike = [](int i, int j) { return i != 2 && j != 2; };
    EXPECT_EQ(decide_best(among).leader, 1);  // 0 may be best, but is 20 % behind
    EXPECT_TRUE(decide_best(among).of[0].may_be_best);
}

/// Of how many scenes, out of `runs`, anything is said that is not true, at 5 %. Strategies are
/// such in truth, the first the best; 16 replicates, noise that is shared and noise of their own.
double share_of_false(const std::vector<double>& truth, double noise, int runs)
{
    Random bits(3);
    std::normal_distribution<double> normal;
    int wrong = 0;
    for (int run = 0; run < runs; ++run) {
        std::vector<std::vector<double>> figures(truth.size(), std::vector<double>(16));
        for (std::size_t r = 0; r < 16; ++r) {
            const double shared = 0.1 * normal(bits);
            for (std::size_t s = 0; s < truth.size(); ++s)
                figures[s][r] = std::exp(truth[s]) * (1 + shared + noise * normal(bits));
        }
        std::vector<Comparison> pairs;
        for (int a = 0; a < static_cast<int>(truth.size()); ++a)
            for (int b = a + 1; b < static_cast<int>(truth.size()); ++b)
                pairs.push_back({a, b, log_contrast(figures[a], 1, figures[b], 1)});
        const Decision d = decide_best({all_of(truth.size()), pairs, truth.size(), 0.05});
        bool is_false = !d.of[0].may_be_best;
        for (std::size_t s = 0; s < truth.size(); ++s)
            is_false = is_false || std::log1p(d.of[s].behind_at_most) < truth[s];
        wrong += is_false || (d.is_decided && truth[d.leader] > std::log1p(most_behind));
    }
    return wrong / static_cast<double>(runs);
}

/// With 4000 runs the bound is passed by chance once in 3 million, if the rate is 5 %.
TEST(Decision, IsWrongNoMoreOftenThanItSays)
{
    constexpr int runs = 4000;
    const std::vector<double> equal(6, 0.0), close{0, 0.06, 0.06, 0.06, 0.06, 0.06},
        two{0, 0, 0.06, 0.5, 0.5, 0.5};
    for (const auto& truth : {equal, close, two})
        for (const double noise : {0.05, 0.2})
            EXPECT_LT(share_of_false(truth, noise, runs), rate_bound(0.05, runs)) << noise;
    // The twin: against one other there is nothing to correct for, and the rate is all but reached.
    EXPECT_GT(share_of_false({0, 0.3}, 0.1, runs), 0.03);
}

/// The twin of the corrections: single tests against a leader that the data chose say too often
/// that it is at most 5 % behind one that is 6 % ahead.
TEST(Decision, BySingleTestsWouldBeWrongTooOften)
{
    constexpr int runs = 4000, count = 12;
    Random bits(4);
    std::normal_distribution<double> normal;
    int wrong = 0;
    for (int run = 0; run < runs; ++run) {
        // One is 6 % ahead of all others; errors are 4 %.
        std::vector<double> logs(count, std::log(1.06));
        logs[0] = 0;
        for (double& log : logs) log += 0.04 / std::sqrt(2.0) * normal(bits);
        const auto leader = std::min_element(logs.begin(), logs.end()) - logs.begin();
        wrong += leader != 0 && logs[leader] - logs[0] + 1.645 * 0.04 <= std::log1p(most_behind);
    }
    EXPECT_GT(wrong / double(runs), 0.05);
}

TEST(Decision, KnowsWhoseSamplesAreTheSame)
{
    StrategyReport a;
    a.samples = 64, a.mean = 1, a.variance.value = 0.1, a.relative_variance.value = 0.2;
    StrategyReport b = a;
    EXPECT_TRUE(have_same_samples(a, b));
    b.variance.value = std::nextafter(0.1, 1);
    EXPECT_FALSE(have_same_samples(a, b));
    a.variance.value = b.variance.value = 0;
    EXPECT_FALSE(have_same_samples(a, b));  // exact: by different ways, perhaps
}

}  // namespace
}  // namespace mis
