#include "mis/sampling/random.h"

#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <set>

namespace mis {
namespace {

/// The words of Philox-4×32-7 for a raw counter; the low bit of the last word is the block.
Words raw(const Words& c, std::uint64_t key)
{
    const Counter counter{c[0], std::uint64_t{c[3] >> 1} << 32 | c[1], c[2]};
    return random_words(key, counter, static_cast<Block>(c[3] & 1));
}

/// The known answers that come with the authors' own code (Random123, kat_vectors).
TEST(Random, IsPhilox4x32With7Rounds)
{
    EXPECT_EQ(raw({0, 0, 0, 0}, 0), (Words{0x5f6fb709, 0x0d893f64, 0x4f121f81, 0x4f730a48}));
    EXPECT_EQ(raw({~0U, ~0U, ~0U, ~0U}, ~0ULL),
              (Words{0x5207ddc2, 0x45165e59, 0x4d8ee751, 0x8c52f662}));
    EXPECT_EQ(raw({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0x299f31d0'a4093822),
              (Words{0x4dfccaba, 0x190a87f0, 0xc47362ba, 0xb6b5242a}));
}

TEST(Random, EveryPartOfTheCounterMatters)
{
    std::set<Words> seen;
    for (const std::uint64_t seed : {1ULL, 2ULL, 1ULL << 32})
        for (const std::uint32_t point : {0U, 1U, 1U << 31})
            for (const std::uint64_t sample : {0ULL, 1ULL, 1ULL << 32, 1ULL << 62})
                for (const std::uint32_t draw : {0U, 1U})
                    for (const Block block : {Block::light, Block::bsdf})
                        EXPECT_TRUE(
                            seen.insert(random_words(seed, {point, sample, draw}, block)).second);
}

TEST(Random, UnitNumbersLieIn0To1AndNeverReach1)
{
    EXPECT_EQ(unit_number<float>(0), 0);
    EXPECT_EQ(unit_number<double>(0), 0);
    EXPECT_LT(unit_number<float>(~0U), 1);
    EXPECT_LT(unit_number<double>(~0U), 1);
    EXPECT_NEAR(static_cast<double>(unit_number<float>(0x12345678)),
                unit_number<double>(0x12345678), 1.0 / (1 << 24));
}

TEST(Random, WordsAreUniformAndPairsIndependent)
{
    constexpr double false_alarm = 1e-6;  // for each of the twelve pairs
    const int draws = scaled(400'000);
    constexpr std::size_t cells = 16;
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b) {
            if (a == b) continue;
            std::vector<double> observed(cells * cells),
                expected(cells * cells, draws / static_cast<double>(cells * cells));
            for (int i = 0; i < draws; ++i) {
                const Words words =
                    random_words(5, {9, static_cast<std::uint64_t>(i), 0}, Block::light);
                ++observed[(words[a] >> 28) * cells + (words[b] >> 28)];
            }
            EXPECT_GT(chi2_p_value(observed, expected), false_alarm) << a << " " << b;
        }
}

}  // namespace
}  // namespace mis
