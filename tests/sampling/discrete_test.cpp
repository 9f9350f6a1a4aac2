#include "mis/sampling/discrete.h"

#include "tests/support/lanes.h"
#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

namespace mis {
namespace {

/// A running sum and what it stands on.
struct OwnedSum {
    std::vector<double> weights, sums;
    RunningSum table;
    explicit OwnedSum(std::vector<double> w) : weights(std::move(w)), sums(weights.size())
    {
        table = RunningSum::over(std::span<const double>(weights), sums);
    }
    Choice choose(std::uint64_t bits) const { return table.choose(bits); }
    double probability(std::int32_t i) const { return table.probability(i); }
};

/// The share of all 2⁶⁴ bit patterns that choose each light, without a random number: cell by cell,
/// the borders between two choices are found by halving. `cells` equal parts of the range hold at
/// most one border each.
template <class Table>
std::vector<double> true_shares(const Table& table, std::size_t lights, std::uint64_t cells)
{
    std::vector<double> share(lights);
    __extension__ using Wide = unsigned __int128;
    const auto start_of = [&](std::uint64_t cell) {
        return static_cast<std::uint64_t>(((static_cast<Wide>(cell) << 64) + cells - 1) / cells);
    };
    for (std::uint64_t cell = 0; cell < cells; ++cell) {
        const std::uint64_t first = start_of(cell);
        const std::uint64_t last = cell + 1 == cells ? ~std::uint64_t{0} : start_of(cell + 1) - 1;
        const std::int32_t own = table.choose(first).light;
        std::uint64_t low = first, high = last;  // low chooses own; high + 1 does not
        while (low < high) {
            const std::uint64_t middle = low + (high - low) / 2 + 1;
            if (table.choose(middle).light == own) low = middle;
            else high = middle - 1;
        }
        share[static_cast<std::size_t>(own)] += static_cast<double>(low - first + 1) * 0x1p-64;
        if (low < last)
            share[static_cast<std::size_t>(table.choose(last).light)] +=
                static_cast<double>(last - low) * 0x1p-64;
    }
    return share;
}

std::vector<double> some_weights(int n, double ratio)
{
    Uniforms uniforms(static_cast<unsigned>(n));
    std::vector<double> weights;
    for (int i = 0; i < n; ++i) weights.push_back(i % 7 == 3 ? 0 : uniforms.log_between(1, ratio));
    return weights;
}

template <class Table> class EveryTable : public testing::Test {
};
using Tables = testing::Types<AliasTable, OwnedSum>;
TYPED_TEST_SUITE(EveryTable, Tables);

TYPED_TEST(EveryTable, TellsTheWeightsShareAsProbability)
{
    const std::vector<double> weights = some_weights(1000, 1e6);
    const TypeParam table(weights);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const double p = table.probability(static_cast<std::int32_t>(i));
        sum += p;
        EXPECT_NEAR(p, weights[i] / total, 1e-7 * weights[i] / total) << i;
    }
    EXPECT_NEAR(sum, 1, 1e-7);
}

TYPED_TEST(EveryTable, DrawsEachAsOftenAsItSays)
{
    constexpr double false_alarm = 1e-6;  // per table
    const int draws = scaled(1'000'000);
    const std::vector<double> weights = some_weights(100, 1e4);
    const TypeParam table(weights);
    std::vector<double> observed(weights.size()), expected;
    for (std::size_t i = 0; i < weights.size(); ++i)
        expected.push_back(draws * table.probability(static_cast<std::int32_t>(i)));
    for (int i = 0; i < draws; ++i) {
        const Choice choice = table.choose(random_bits(7, static_cast<std::uint64_t>(i)));
        ASSERT_EQ(choice.probability, table.probability(choice.light));
        ++observed[static_cast<std::size_t>(choice.light)];
    }
    EXPECT_GT(chi2_p_value(observed, expected), false_alarm);
}

TYPED_TEST(EveryTable, NeverDrawsAWeightOf0AndAlwaysTheOnlyOther)
{
    for (const std::size_t place : {0U, 3U, 6U}) {
        std::vector<double> weights(7, 0.0);
        weights[place] = 1e-300;
        const TypeParam table(weights);
        for (const std::uint64_t bits :
             {std::uint64_t{0}, std::uint64_t{1} << 63, ~std::uint64_t{0}}) {
            EXPECT_EQ(table.choose(bits).light, static_cast<std::int32_t>(place));
            EXPECT_NEAR(table.choose(bits).probability, 1, 1e-15);
        }
    }
}

TYPED_TEST(EveryTable, WithoutAWeightDrawsNone)
{
    for (const std::size_t n : {0U, 1U, 5U}) {
        const TypeParam table(std::vector<double>(n, 0.0));
        EXPECT_EQ(table.choose(123).light, -1);
        EXPECT_EQ(table.choose(123).probability, 0);
        for (std::size_t i = 0; i < n; ++i)
            EXPECT_EQ(table.probability(static_cast<std::int32_t>(i)), 0);
    }
}

TYPED_TEST(EveryTable, ARatioOf1e12BetweenWeightsKeepsTheRareOne)
{
    const TypeParam table(std::vector<double>{1, 1e12, 1});
    EXPECT_NEAR(table.probability(0) * 1e12, 1, 1e-3);
    EXPECT_NEAR(table.probability(2) * 1e12, 1, 1e-3);
}

/// What is drawn is what is divided by, to 1e-6, for the rare ones and for the one that all others
/// are topped up with.
TYPED_TEST(EveryTable, TheTrueShareOfEachIsItsProbability)
{
    std::vector<double> nearly_equal(100'000, 1.0), ratios = some_weights(1000, 1e9);
    nearly_equal[777] = 2;
    for (const std::vector<double>& weights : {nearly_equal, ratios}) {
        const TypeParam table(weights);
        // A running sum has as many borders as weights, an alias table one per cell.
        if constexpr (std::is_same_v<TypeParam, AliasTable>) {
            const std::vector<double> share = true_shares(table, weights.size(), weights.size());
            for (std::size_t i = 0; i < weights.size(); ++i) {
                const double p = table.probability(static_cast<std::int32_t>(i));
                ASSERT_NEAR(share[i], p, 1e-6 * p) << i << " of " << weights.size();
            }
        } else {
            double below = 0;
            for (std::size_t i = 0; i < weights.size(); ++i) {
                const double p = table.probability(static_cast<std::int32_t>(i));
                if (p > 0) {
                    const auto inside = static_cast<std::uint64_t>(std::ldexp(below + 0.5 * p, 64));
                    ASSERT_EQ(table.choose(inside).light, static_cast<std::int32_t>(i));
                }
                below += p;
            }
        }
    }
}

/// Borders of a block: each place that counts is drawn over its own weight of the sum, the others
/// never.
TEST(Block, EachPlaceIsDrawnOverItsOwnWeight)
{
    for (const double ratio : {1.0, 1e9})
        for (std::size_t empty = 0; empty <= block_size; ++empty) {
            const std::vector<double> logs = some_weights(block_size, ratio);
            std::array<float, block_size> weights{};
            double sum = 0;
            for (std::size_t k = 0; k < block_size; ++k) {
                weights[k] = k == empty || k + 1 == empty ? 0 : static_cast<float>(logs[k]);
                sum += static_cast<double>(weights[k]);
            }
            EXPECT_NEAR(sum_of_block(weights.data()), sum, 1e-15 * sum);
            double below = 0;
            for (std::size_t k = 0; k < block_size; ++k) {
                const double w = static_cast<double>(weights[k]);
                for (const double share : {1e-3, 0.5, 0.999})
                    if (w > 0) {
                        ASSERT_EQ(place_in_block(weights.data(), below + share * w), k) << empty;
                    }
                below += w;
            }
            // What rounding leaves beyond the sum.
            EXPECT_GT(weights[place_in_block(weights.data(), sum)], 0);
            EXPECT_GT(weights[place_in_block(weights.data(), sum * 1.001)], 0);
            EXPECT_GT(weights[place_in_block(weights.data(), 0)], 0);
        }
}

/// However far beyond the sum, and wherever the only weight stands.
TEST(Block, TheOnlyPlaceThatCountsIsDrawnAlways)
{
    for (std::size_t k = 0; k < block_size; ++k) {
        std::array<float, block_size> weights{};
        weights[k] = 1e-30F;
        for (const double share : {0.0, 0.5, 1.0, 1.001})
            EXPECT_EQ(place_in_block(weights.data(), share * 1e-30), k);
    }
}

TEST(Block, ItsSumIsThatOfDoubles)
{
    std::array<float, block_size> weights{};
    weights[3] = 1e8F, weights[12] = 1, weights[15] = 0.25F;
    EXPECT_EQ(sum_of_block(weights.data()), 1e8 + 1.25);
    std::array<double, block_size> doubles{};
    for (std::size_t k = 0; k < block_size; ++k) doubles[k] = static_cast<double>(1 << k);
    EXPECT_EQ(sum_of_block(doubles.data()), 65535.0);
}

/// With weights of 0 first, last and between, bits at the ends, and numbers of draws that fill no
/// lanes.
TEST(RunningSum, ChoosesManyAsItChoosesOne)
{
    Uniforms uniforms(91);
    for (std::size_t lights = 1; lights <= 16; ++lights)
        for (int turn = 0; turn < 20; ++turn) {
            std::vector<double> weights(lights);
            for (double& w : weights) w = uniforms() < 0.4 ? 0 : uniforms.log_between(1e-12, 1e3);
            const OwnedSum owned(weights);
            std::vector<std::uint64_t> bits{0, ~std::uint64_t{0}};
            for (int i = uniforms.below(40); i > 0; --i) {
                const auto high = static_cast<std::uint64_t>(uniforms() * 0x1p32);
                bits.push_back(high << 32 | static_cast<std::uint64_t>(uniforms() * 0x1p32));
            }
            std::size_t seen = 0;
            owned.table.choose_many<TestLanes<double>>(bits, [&](std::size_t i, const Choice& c) {
                EXPECT_EQ(i, seen++);
                EXPECT_EQ(c.light, owned.choose(bits[i]).light);
                EXPECT_EQ(c.probability, owned.choose(bits[i]).probability);
            });
            EXPECT_EQ(seen, bits.size());
        }
}

}  // namespace
}  // namespace mis
