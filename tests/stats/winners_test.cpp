#include "mis/stats/winners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mis {
namespace {

using Random = std::mt19937_64;

/// `samples` exponential numbers of mean 1 and a variance of `variance` at one point of a place.
PlaceSamples exponential_place(Random& bits, double variance, int samples, double mean = 1)
{
    std::exponential_distribution<double> draw(1);
    Moments moments;
    for (int i = 0; i < samples; ++i) moments.add(mean + std::sqrt(variance) * (draw(bits) - 1));
    PlaceSamples place;
    place.add(moments);
    return place;
}

std::vector<int> told(const std::vector<std::vector<PlaceSamples>>& places,
                      const std::vector<double>& costs, const std::vector<int>& groups)
{
    std::vector<Candidate> candidates;
    for (const auto& place : places) candidates.push_back(candidate(place, {costs, groups}));
    return winners_of(candidates);
}

std::size_t decided(const std::vector<int>& winners)
{
    return static_cast<std::size_t>(
        std::count_if(winners.begin(), winners.end(), [](int w) { return w >= 0; }));
}

/// 400 samples tell a variance of such numbers to ± 14 %: four times as much is surely more.
TEST(Winners, AreToldWhereOneIsFarAhead)
{
    Random bits(1);
    std::vector<std::vector<PlaceSamples>> places;
    for (int p = 0; p < 200; ++p)
        places.push_back({exponential_place(bits, p < 100 ? 1 : 4, 400),
                          exponential_place(bits, p < 100 ? 4 : 1, 400),
                          exponential_place(bits, 8, 400)});
    const std::vector<int> winners = told(places, {1, 1, 1}, {0, 1, 2});
    EXPECT_GT(decided(winners), 180U);
    for (std::size_t p = 0; p < winners.size(); ++p)
        EXPECT_TRUE(winners[p] < 0 || winners[p] == (p < 100 ? 0 : 1));
}

/// Where all are alike every winner is wrong, and there is one at all with probability 5 % at most;
/// one seed in forty may be unlucky (expected: less than two).
TEST(Winners, AreNotToldWhereAllAreAlike)
{
    int wrong = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        Random bits(seed);
        std::vector<std::vector<PlaceSamples>> places(200);
        for (auto& place : places)
            for (int s = 0; s < 4; ++s) place.push_back(exponential_place(bits, 1, 100));
        wrong += decided(told(places, {1, 1, 1, 1}, {0, 1, 2, 3})) > 0;
    }
    // P(more than 7 of 40 at 5 % each) = 6e-4; the seeds are fixed.
    EXPECT_LE(wrong, 7);
}

/// Twins keep each other from winning, but not their group.
TEST(Winners, OfAGroupNeedNotLeadTheirTwins)
{
    Random bits(3);
    std::vector<std::vector<PlaceSamples>> places;
    for (int p = 0; p < 100; ++p)
        places.push_back({exponential_place(bits, 1, 400), exponential_place(bits, 1, 400),
                          exponential_place(bits, 4, 400)});
    EXPECT_LT(decided(told(places, {1, 1, 1}, {0, 1, 2})), 10U);
    EXPECT_GT(decided(told(places, {1, 1, 1}, {0, 0, 2})), 80U);
    EXPECT_EQ(decided(told(places, {1, 1, 1}, {5, 5, 5})), 0U);
}

/// A dear sample loses what a small variance wins.
TEST(Winners, WeighVarianceByCost)
{
    Random bits(4);
    std::vector<std::vector<PlaceSamples>> places;
    for (int p = 0; p < 50; ++p)
        places.push_back({exponential_place(bits, 1, 400), exponential_place(bits, 4, 400)});
    for (const int w : told(places, {16, 1}, {0, 1})) EXPECT_NE(w, 0);
    EXPECT_GT(decided(told(places, {16, 1}, {0, 1})), 40U);
}

/// Its samples are alike because it never met what makes the mean of the other, or it is carried
/// by a few.
TEST(Winners, AreNotThoseThatMissedSomething)
{
    Random bits(5);
    Moments rare, quiet;
    for (int i = 0; i < 400; ++i) rare.add(i < 3 ? 100 : 0), quiet.add(i < 6 ? 1.1 : 1);
    PlaceSamples carried_by_three, carried_by_six;
    carried_by_three.add(rare);
    carried_by_six.add(quiet);
    std::vector<std::vector<PlaceSamples>> low_mean, few, lucky;
    for (int p = 0; p < 50; ++p) {
        low_mean.push_back(
            {exponential_place(bits, 0.01, 400, 0.2), exponential_place(bits, 4, 400)});
        few.push_back({exponential_place(bits, 0.01, 400), carried_by_three});
        lucky.push_back({carried_by_six, exponential_place(bits, 4, 400)});
    }
    EXPECT_EQ(decided(told(low_mean, {1, 1}, {0, 1})), 0U);
    EXPECT_EQ(decided(told(few, {1, 1}, {0, 1})), 0U);
    EXPECT_EQ(decided(told(lucky, {1, 1}, {0, 1})), 0U);
}

TEST(Winners, AreToldForSquaresOfTwoThousandSamples)
{
    EXPECT_EQ(winner_square(5000), 1);
    EXPECT_EQ(winner_square(500), 2);
    EXPECT_EQ(winner_square(32), 8);
    EXPECT_EQ(winner_square(0.1), 16);
}

}  // namespace
}  // namespace mis
