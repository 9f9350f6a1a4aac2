// Variances from shared directions, as pure sums: unbiased for any centre, exact where all is even.
#include "mis/stats/centred_sums.h"

#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace mis {
namespace {

/// A technique that draws one of four places, and what each is worth.
constexpr std::array probability{0.5, 0.3, 0.15, 0.05};
constexpr std::array worth{1.0, 2.0, 0.0, 9.0};
/// The places are drawn so in its stead, eight in each group.
constexpr std::array mixture{0.2, 0.2, 0.3, 0.3};
constexpr int draws = 8;

double true_variance()
{
    double mean = 0, square = 0;
    for (std::size_t i = 0; i < worth.size(); ++i)
        mean += probability[i] * worth[i], square += probability[i] * worth[i] * worth[i];
    return square - mean * mean;
}

CentredSums round_of(double center, std::mt19937_64& random, double scale = 1, double even = 0)
{
    std::discrete_distribution<std::size_t> place(mixture.begin(), mixture.end());
    CentredSums sums(center);
    for (std::size_t g = 0; g < shared_groups; ++g)
        for (int i = 0; i < draws; ++i) {
            const std::size_t k = place(random);
            sums.add(g, even + scale * worth[k], probability[k] / (draws * mixture[k]));
        }
    return sums;
}

/// Of many rounds, each centred alike.
ReplicateSquares variances(double center, int rounds)
{
    std::mt19937_64 random(7);
    ReplicateSquares found;
    for (int r = 0; r < rounds; ++r) found.add(round_of(center, random).variance());
    return found;
}

// False alarm: 1e-6 over all centres.
TEST(CentredSums, AreUnbiasedForAnyCentre)
{
    const int rounds = 40'000;
    for (const double center : {0.0, 1.55, 20.0}) {
        const ReplicateSquares found = variances(center, rounds);
        EXPECT_NEAR(found.mean(rounds), true_variance(),
                    z_bound(1e-6, 3) * std::sqrt(found.squared_error(rounds)))
            << center;
    }
}

TEST(CentredSums, KnowMoreTheCloserTheirCentreIs)
{
    const int rounds = 4'000;
    const auto noise = [&](double center) {
        return variances(center, rounds).squared_error(rounds);
    };
    EXPECT_LT(noise(1.55), 0.8 * noise(0));
    EXPECT_LT(100 * noise(1.55), noise(20));
}

TEST(CentredSums, OfEqualValuesAreExactAboutThem)
{
    std::mt19937_64 random(3);
    EXPECT_EQ(round_of(2.5, random, 0, 2.5).variance(), 0);
    EXPECT_EQ(round_of(0, random, 0, 0).variance(), 0);
    EXPECT_NEAR(round_of(2.5, random, 0, 2.5 * (1 + 1e-9)).variance(), 0, 1e-16);
}

TEST(CentredSums, SayTheMeanAndTheMassWhateverTheirCentre)
{
    std::mt19937_64 a(5), b(5);
    const CentredSums plain = round_of(0, a), centred = round_of(3, b);
    EXPECT_NEAR(plain.mean(), centred.mean(), 1e-12);
    EXPECT_NEAR(plain.mass(), centred.mass(), 1e-12);
}

/// A technique that is worth 0 wherever it draws elsewhere needs no draws there.
TEST(CentredSums, TakeWhatIsKnownToBeWorthNothing)
{
    std::mt19937_64 random(11);
    std::discrete_distribution<std::size_t> place(mixture.begin(), mixture.end());
    const int rounds = 40'000;
    ReplicateSquares found;
    for (int r = 0; r < rounds; ++r) {
        CentredSums sums(1.5);
        sums.add_known(1);
        for (std::size_t g = 0; g < shared_groups; ++g)
            for (int i = 0; i < draws; ++i) {
                const std::size_t k = place(random);
                if (worth[k] > 0)
                    sums.add_beyond_0(g, worth[k], probability[k] / (draws * mixture[k]));
            }
        found.add(sums.variance());
    }
    EXPECT_NEAR(found.mean(rounds), true_variance(),
                z_bound(1e-6, 1) * std::sqrt(found.squared_error(rounds)));
}

}  // namespace
}  // namespace mis
