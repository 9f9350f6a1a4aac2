// Sums of V/(μ² + ε²) where both are estimated from the same few rounds.
#include "mis/stats/relative_sum.h"

#include "tests/support/simulated.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace mis {
namespace {

/// Of a point, from rounds whose two figures go together.
struct Rounds {
    std::vector<double> variances, means;

    ValueAndError of(const std::vector<double>& x) const
    {
        const MeanAndError found = mean_and_error(x);
        return {found.mean, found.se};
    }
    double covariance() const
    {
        const auto n = static_cast<double>(means.size());
        double sum = 0;
        for (std::size_t r = 0; r < means.size(); ++r)
            sum += (variances[r] - of(variances).value) * (means[r] - of(means).value);
        return sum / n / (n - 1);
    }
};

Rounds rounds_of(Random& bits, int count, double common)
{
    std::normal_distribution<double> noise(0, 1);
    Rounds rounds;
    for (int r = 0; r < count; ++r) {
        const double shared = noise(bits);
        rounds.variances.push_back(2 + common * shared + 0.3 * noise(bits));
        rounds.means.push_back(1 + 0.5 * common * shared + 0.2 * noise(bits));
    }
    return rounds;
}

struct Repeated {
    Moments naive, corrected, se2;
};

Repeated repeat(double common, double epsilon)
{
    Random bits(7);
    Repeated found;
    for (int run = 0; run < 4000; ++run) {
        RelativeSum sum(epsilon);
        double naive = 0;
        for (int point = 0; point < 4; ++point) {
            const Rounds rounds = rounds_of(bits, 16, common);
            const ValueAndError v = rounds.of(rounds.variances), mean = rounds.of(rounds.means);
            sum.add(v, mean, rounds.covariance());
            naive += v.value / (mean.value * mean.value + epsilon * epsilon);
        }
        found.naive.add(naive);
        found.corrected.add(sum.value());
        found.se2.add(sum.se() * sum.se());
    }
    return found;
}

// The mean of 4000 sums is off by 4.4 of its standard errors once in 10⁵ tests; what is off itself
// is ten times as far.
TEST(RelativeSum, IsRightInTheMeanWhereTheRatioIsNot)
{
    for (const double common : {0.0, 0.6}) {
        const double epsilon = 0.1, right = 4 * 2 / (1 + epsilon * epsilon);
        const Repeated found = repeat(common, epsilon);
        const double naive_off = std::fabs(found.naive.mean - right),
                     off = std::fabs(found.corrected.mean - right);
        EXPECT_LT(off, 4.4 * found.corrected.mean_se() + 0.1 * naive_off) << common;
        EXPECT_GT(naive_off, 3 * off) << common;
    }
}

TEST(RelativeSum, KnowsItsError)
{
    const Repeated found = repeat(0.6, 0.1);
    EXPECT_NEAR(found.se2.mean / found.corrected.variance(), 1, 0.15);
}

TEST(RelativeSum, LeavesOutWhatHasNoMeanAndNoEpsilon)
{
    RelativeSum sum(0);
    sum.add({1, 0.1}, {0, 0}, 0);
    EXPECT_EQ(sum.value(), 0);
    EXPECT_EQ(sum.se(), 0);
    sum.add({1, 0}, {2, 0}, 0);
    EXPECT_EQ(sum.value(), 0.25);
    EXPECT_EQ(sum.correction(), 0);
}

}  // namespace
}  // namespace mis
