#include "mis/math/moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace mis {
namespace {

struct Exact {
    long double mean = 0, m2 = 0, m3 = 0, m4 = 0;
};

/// Two passes in long double.
Exact exactly(const std::vector<double>& samples)
{
    Exact e;
    for (const double x : samples) e.mean += static_cast<long double>(x);
    e.mean /= static_cast<long double>(samples.size());
    for (const double x : samples) {
        const long double d = static_cast<long double>(x) - e.mean;
        e.m2 += d * d;
        e.m3 += d * d * d;
        e.m4 += d * d * d * d;
    }
    return e;
}

/// Skewed numbers, like the samples of a rare bright light.
std::vector<double> skewed(std::size_t n, double offset, unsigned seed)
{
    std::mt19937 bits(seed);
    std::exponential_distribution<double> rare(1);
    std::vector<double> samples(n);
    for (double& x : samples) x = offset + (bits() % 8 == 0 ? 10 * rare(bits) : 0.1 * rare(bits));
    return samples;
}

Moments one_by_one(const std::vector<double>& samples)
{
    Moments m;
    for (const double x : samples) m.add(x);
    return m;
}

Moments in_pieces(const std::vector<double>& samples, std::size_t piece)
{
    Moments m;
    for (std::size_t i = 0; i < samples.size(); i += piece) {
        const std::size_t n = std::min(piece, samples.size() - i);
        m.merge(Moments::of(std::span<const double>(samples).subspan(i, n)));
    }
    return m;
}

void expect_near(const Moments& m, const Exact& e, long double relative)
{
    EXPECT_NEAR(m.mean, double(e.mean), double(relative * std::fabs(e.mean)));
    EXPECT_NEAR(m.m2, double(e.m2), double(relative * e.m2));
    EXPECT_NEAR(m.m3, double(e.m3), double(relative * std::fabs(e.m3)));
    EXPECT_NEAR(m.m4, double(e.m4), double(relative * e.m4));
}

TEST(Moments, OfASpanMatchLongDouble)
{
    const auto samples = skewed(10'000, 0, 1);
    expect_near(Moments::of(std::span<const double>(samples)), exactly(samples), 1e-13L);
}

TEST(Moments, AddedOneByOneMatchLongDouble)
{
    const auto samples = skewed(10'000, 0, 2);
    expect_near(one_by_one(samples), exactly(samples), 1e-11L);
}

TEST(Moments, MergedFromPiecesOfAnySizeMatchLongDouble)
{
    const auto samples = skewed(10'007, 0, 3);
    for (const std::size_t piece : {1u, 2u, 7u, 64u, 5000u, 20'000u})
        expect_near(in_pieces(samples, piece), exactly(samples), 1e-11L);
}

TEST(Moments, MergeInEitherGroupingToTheSame)
{
    const auto a = one_by_one(skewed(100, 0, 4)), b = one_by_one(skewed(7, 3, 5)),
               c = one_by_one(skewed(999, -1, 6));
    Moments left = a, right = b, result = a;
    left.merge(b);
    left.merge(c);
    right.merge(c);
    result.merge(right);
    EXPECT_EQ(left.count, result.count);
    EXPECT_NEAR(left.mean, result.mean, 1e-14 * std::fabs(left.mean));
    EXPECT_NEAR(left.m2, result.m2, 1e-13 * left.m2);
    EXPECT_NEAR(left.m3, result.m3, 1e-12 * std::fabs(left.m3));
    EXPECT_NEAR(left.m4, result.m4, 1e-13 * left.m4);
}

TEST(Moments, KeepTheirDigitsOnAHugeOffset)
{
    const auto samples = skewed(4096, 1e9, 7);  // a naive Σx² − n·mean² keeps no digit here
    const Exact e = exactly(samples);
    for (const Moments& m : {Moments::of(std::span<const double>(samples)), one_by_one(samples),
                             in_pieces(samples, 32)}) {
        EXPECT_NEAR(m.m2, double(e.m2), 1e-6 * double(e.m2));
        EXPECT_NEAR(m.m4, double(e.m4), 1e-6 * double(e.m4));
    }
    double sum = 0, sum_of_squares = 0;  // the twin that shows the test can fail
    for (const double x : samples) sum += x, sum_of_squares += x * x;
    EXPECT_GT(std::fabs(sum_of_squares - sum * sum / 4096 - double(e.m2)), 1e-3 * double(e.m2));
}

TEST(Moments, OfFloatsAreTakenInDouble)
{
    const std::vector<float> samples{1.f, 2.f, 4.f, 8.f};
    const Moments m = Moments::of(std::span<const float>(samples));
    EXPECT_EQ(m.mean, 3.75);
    EXPECT_DOUBLE_EQ(m.m2, 28.75);
}

TEST(Moments, OfNothingMergeToNothing)
{
    const Moments something = one_by_one({1, 2, 5});
    Moments m;
    m.merge(Moments{});
    EXPECT_EQ(m.count, 0u);
    EXPECT_TRUE(std::isnan(m.variance()));
    EXPECT_TRUE(std::isnan(m.mean_se()));
    EXPECT_TRUE(std::isnan(m.variance_se()));
    EXPECT_EQ(m.effective_count(), 0);
    m.merge(something);
    EXPECT_EQ(m.m4, something.m4);
    m.merge(Moments{});
    EXPECT_EQ(m.mean, something.mean);
    EXPECT_EQ(Moments::of(std::span<const double>()).count, 0u);
}

TEST(Moments, OfOneNumberHaveNoVariance)
{
    Moments m;
    m.add(7);
    EXPECT_EQ(m.mean, 7);
    EXPECT_EQ(m.m2, 0);
    EXPECT_TRUE(std::isnan(m.variance()));
    EXPECT_TRUE(std::isnan(m.kurtosis()));
}

TEST(Moments, OfEqualNumbersAreExactlyZero)
{
    const std::vector<double> same(1000, 0.1);
    for (const Moments& m :
         {Moments::of(std::span<const double>(same)), one_by_one(same), in_pieces(same, 13)}) {
        EXPECT_EQ(m.m2, 0);
        EXPECT_EQ(m.m4, 0);
        EXPECT_EQ(m.variance_se(), 0);
    }
}

TEST(Moments, KurtosisOfARareEventIsOneOverItsProbability)
{
    Moments m;
    for (int i = 0; i < 10'000; ++i) m.add(i % 1000 == 0 ? 1 : 0);
    EXPECT_NEAR(m.kurtosis(), 1000, 5);
    EXPECT_NEAR(m.effective_count(), 10, 0.1);
}

// The variance of 4000 nearly normal numbers is known to 2.2 %, so 12 % is past 5 sigma: false
// alarm below 1e-6.
TEST(Moments, StandardErrorOfTheVarianceIsItsSpread)
{
    std::mt19937_64 bits(8);
    std::uniform_real_distribution<double> uniform;
    Moments variances;
    double predicted = 0;
    for (int i = 0; i < 4000; ++i) {
        Moments m;
        for (int k = 0; k < 50; ++k) m.add(uniform(bits));
        variances.add(m.variance());
        predicted += m.variance_se() * m.variance_se() / 4000;
    }
    const double sigma4 = 1.0 / 144, mu4 = 1.0 / 80;
    EXPECT_NEAR(variances.variance(), (mu4 - sigma4 * 47 / 49) / 50, 0.12 * variances.variance());
    EXPECT_NEAR(predicted, variances.variance(), 0.12 * predicted);
}

}  // namespace
}  // namespace mis
