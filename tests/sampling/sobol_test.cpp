#include "mis/sampling/sobol.h"

#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace mis {
namespace {

constexpr std::array dimensions{Dimension::choice, Dimension::light_u, Dimension::light_v,
                                Dimension::technique};

/// Unscrambled, over 2³².
std::uint32_t plain_word(Dimension dimension, std::uint32_t index)
{
    const auto columns = sobol_columns(dimension);
    std::uint32_t word = 0;
    for (std::size_t bit = 0; bit < 32; ++bit)
        if ((index >> bit & 1) != 0) word ^= columns[bit];
    return reversed_bits(word);
}

/// The first points as they are printed in Joe and Kuo's notes, there in the order of Gray codes:
/// point i stands at i ^ i/2.
TEST(Sobol, FirstPointsAreThoseOfJoeAndKuo)
{
    const std::array<std::array<double, 4>, 8> printed{{{0, 0, 0, 0},
                                                        {0.5, 0.5, 0.5, 0.5},
                                                        {0.75, 0.25, 0.25, 0.25},
                                                        {0.25, 0.75, 0.75, 0.75},
                                                        {0.375, 0.375, 0.625, 0.875},
                                                        {0.875, 0.875, 0.125, 0.375},
                                                        {0.625, 0.125, 0.875, 0.625},
                                                        {0.125, 0.625, 0.375, 0.125}}};
    for (std::uint32_t i = 0; i < 8; ++i)
        for (std::size_t d = 0; d < 4; ++d)
            EXPECT_EQ(plain_word(dimensions[d], i ^ i >> 1) * 0x1p-32, printed[i][d])
                << i << " " << d;
}

/// Do the points [first, first + 2^m) of a scrambled sequence lie one in each interval of length
/// 2^-m? So they do by theorem, wherever first is a multiple of 2^m: (0, m, 1)-nets.
bool stratifies(Dimension dimension, int m, std::uint32_t first, std::uint32_t key)
{
    std::vector<bool> taken(std::size_t{1} << m);
    for (std::uint32_t i = 0; i < taken.size(); ++i) {
        const std::uint32_t word = sobol_word(dimension, first + i, key);
        const std::size_t cell = m == 0 ? 0 : word >> (32 - m);
        if (taken[cell]) return false;
        taken[cell] = true;
    }
    return true;
}

TEST(Sobol, EveryDimensionTakesEachIntervalOnce)
{
    for (const Dimension dimension : dimensions)
        for (int m = 0; m <= 12; ++m)
            for (std::uint32_t k = 0; k < 8; ++k) {
                const auto key = static_cast<std::uint32_t>(random_bits(3, k) >> 32);
                for (const std::uint32_t block : {0U, 1U, 5U, (0xFFFF'FFFFu >> m)})
                    ASSERT_TRUE(stratifies(dimension, m, block << m, key))
                        << int(dimension) << " " << m << " " << k;
            }
    // Blocks that begin elsewhere do not: the test can fail.
    EXPECT_FALSE(stratifies(Dimension::light_v, 6, 31, 0x9abc'def0u));
}

/// The first two dimensions together: one point in each elementary interval of area 2^-m, however
/// it is cut, (0, m, 2)-nets.
TEST(Sobol, FirstTwoDimensionsTakeEachElementaryIntervalOnce)
{
    constexpr int m = 10;
    for (std::uint32_t k = 0; k < 8; ++k) {
        const Words keys = scrambling_keys(7, 11, {k, 0}, 0, Block::light);
        for (int cut = 0; cut <= m; ++cut) {
            std::vector<int> count(std::size_t{1} << m);
            for (std::uint32_t i = 0; i < count.size(); ++i) {
                const std::uint64_t x = sobol_word(Dimension::choice, i, keys[key_of::choice]),
                                    y = sobol_word(Dimension::light_u, i, keys[key_of::light_u]);
                ++count[(x >> (32 - cut)) << (m - cut) | y >> (32 - (m - cut))];
            }
            ASSERT_EQ(std::count(count.begin(), count.end(), 1), count.size()) << cut;
        }
    }
}

/// All 32 digits are scrambled, and each by the digits before it alone.
TEST(Sobol, ScramblingKeepsWhatTheFirstDigitsHaveInCommon)
{
    for (std::uint32_t k = 0; k < 1000; ++k) {
        const std::uint64_t bits = random_bits(5, k);
        const auto x = static_cast<std::uint32_t>(bits),
                   key = static_cast<std::uint32_t>(bits >> 32);
        for (int digit = 0; digit < 32; ++digit) {
            const std::uint32_t other = x ^ 1U << digit;  // reversed: digit 0 is the first
            const std::uint32_t difference = owen_scrambled(x, key) ^ owen_scrambled(other, key);
            ASSERT_EQ(reversed_bits(difference) & ((2U << digit) - 1), 1U << digit) << digit;
        }
    }
}

/// Over independent scramblings: 1 % of false alarms would be 1 in 100 seeds; this is 1e-6 for each
/// point and dimension. (first, second): points of one sequence, of which the second must be
/// uniform too where the first is known, but for the first digit, in which they always differ.
TEST(Sobol, PointsAreUniformOverScramblings)
{
    constexpr double false_alarm = 1e-6;
    constexpr std::size_t cells = 64;
    const int scramblings = scaled(64'000);
    for (const std::size_t d : {0U, 1U, 2U}) {
        const std::array keys{key_of::choice, key_of::light_u, key_of::light_v};
        for (const std::uint32_t index : {0U, 1U, 5U, 0x8000'0001u}) {
            std::vector<double> observed(cells),
                expected(cells, scramblings / static_cast<double>(cells));
            for (int s = 0; s < scramblings; ++s) {
                const Words key =
                    scrambling_keys(1, 9, {static_cast<std::uint64_t>(s), 0}, 0, Block::light);
                ++observed[sobol_word(dimensions[d], index, key[keys[d]]) >> 26];
            }
            EXPECT_GT(chi2_p_value(observed, expected), false_alarm) << d << " " << index;
        }
    }
}

/// Two neighbouring scramblings, points, streams or blocks: pairs of their first points are
/// uniform over the square.
TEST(Sobol, ScramblingsAreIndependent)
{
    constexpr double false_alarm = 1e-6;  // for each pair
    constexpr std::size_t cells = 16;
    const int pairs = scaled(64'000);
    const auto word = [](std::uint32_t point, std::uint64_t scrambling, std::uint32_t stream,
                         Block block) {
        const Words keys = scrambling_keys(1, point, {scrambling, 0}, stream, block);
        return sobol_word(Dimension::light_u, 3, keys[1]);
    };
    for (int kind = 0; kind < 5; ++kind) {
        std::vector<double> observed(cells * cells),
            expected(cells * cells, pairs / static_cast<double>(cells * cells));
        for (int i = 0; i < pairs; ++i) {
            const auto s = static_cast<std::uint64_t>(2 * i);
            const auto p = static_cast<std::uint32_t>(i);
            const std::uint32_t a = word(p, s, 0, Block::light);
            const std::uint32_t b =
                kind == 0   ? word(p, s + 1, 0, Block::light)
                : kind == 1 ? word(p + 1'000'000, s, 0, Block::light)
                : kind == 2 ? word(p, s, 1, Block::light)
                : kind == 3 ? word(p, s, 0, Block::bsdf)
                            : sobol_word(Dimension::light_u, 3,
                                         scrambling_keys(1, p, {s, 0}, 0, Block::light)[2]);
            ++observed[(a >> 28) * cells + (b >> 28)];
        }
        EXPECT_GT(chi2_p_value(observed, expected), false_alarm) << kind;
    }
}

/// The variance of ∫∫xy dx dy by 64 points, over scramblings, against 7/144/64 of independent ones:
/// of true nested uniform scrambling it is some hundred times less. Relative standard error of the
/// measured one: about √(2/2000) = 3 %.
TEST(Sobol, SmoothFunctionsGainMuch)
{
    constexpr std::uint32_t n = 64;
    const int scramblings = scaled(2000);
    double squares = 0, sum = 0;
    for (int s = 0; s < scramblings; ++s) {
        const Words keys =
            scrambling_keys(1, 2, {static_cast<std::uint64_t>(s), 0}, 0, Block::light);
        double mean = 0;
        for (std::uint32_t i = 0; i < n; ++i)
            mean += sobol_word(Dimension::choice, i, keys[0]) * 0x1p-32 *
                    sobol_word(Dimension::light_u, i, keys[1]) * 0x1p-32 / n;
        sum += mean - 0.25, squares += (mean - 0.25) * (mean - 0.25);
    }
    const double variance = squares / scramblings, independent = 7.0 / 144 / n;
    EXPECT_GT(independent / variance, 100);
    EXPECT_LT(std::fabs(sum / scramblings), z_bound(1e-6, 1) * std::sqrt(variance / scramblings));
}

TEST(Sobol, ASampleIsNamedByItsNumberAlone)
{
    const SequencePoint at = SequencePoint::of(16, 16 * 5 + 3, 4, 2);
    EXPECT_EQ(at.scrambling, 5U);
    EXPECT_EQ(at.index, 3U * 4 + 2);
    // A sequence of 2³² points ends, and another begins.
    std::set<Words> seen;
    for (const std::uint64_t index : {0ULL, 1ULL << 32, 2ULL << 32})
        EXPECT_TRUE(seen.insert(scrambling_keys(1, 2, {3, index}, 0, Block::light)).second);
    EXPECT_FALSE(seen.insert(scrambling_keys(1, 2, {3, 77}, 0, Block::light)).second);
}

}  // namespace
}  // namespace mis
