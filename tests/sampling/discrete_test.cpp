#include "mis/sampling/discrete.h"

#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace mis
