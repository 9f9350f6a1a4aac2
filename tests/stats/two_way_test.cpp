#include "mis/stats/two_way.h"

#include "mis/math/limits.h"
#include "tests/support/simulated.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mis {
namespace {

using Table = std::vector<std::vector<double>>;

TEST(TwoWay, OfAFullTableIsByMeansOfRowsAndColumns)
{
    const Table table{{1, 4, 2}, {3, 5, 7}};
    const TwoWayFit fit = fit_two_way(table);
    const double all = 22.0 / 6;
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(fit.columns[c], 0.5 * (table[0][c] + table[1][c]) - all, 1e-12);
    EXPECT_EQ(fit.dof, 2);
    // Halves of the differences 2, 1, 5, less their mean: −1/3, −5/6, 7/6 in either row.
    EXPECT_NEAR(fit.noise, std::sqrt(2 * (1 + 6.25 + 12.25) / 9 / 2), 1e-12);
}

/// A row that begins late, one that ends early, a column of one cell, and one of none.
TEST(TwoWay, FindsASumExactlyThoughCellsAreMissing)
{
    const std::vector<double> rows{0.3, -2, 5, 1}, columns{1, -1, 0.5, 7, 0, 3};
    Table table(4, std::vector<double>(6));
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 6; ++c) table[r][c] = rows[r] + columns[c];
    table[0][0] = table[0][1] = nan;
    table[1].resize(2);
    for (std::size_t r = 0; r < 4; ++r)
        if (r < 1 || r > 1) table[r][4] = nan;
    table[2][5] = table[0][5] = nan;
    const TwoWayFit fit = fit_two_way(table);
    double mean = 0;
    for (const std::size_t c : {0, 1, 2, 3, 5}) mean += columns[c] / 5;
    for (const std::size_t c : {0, 1, 2, 3, 5})
        EXPECT_NEAR(fit.columns[c], columns[c] - mean, 1e-12) << c;
    EXPECT_EQ(fit.columns[4], 0);
    EXPECT_NEAR(fit.noise, 0, 1e-12);
    EXPECT_EQ(fit.dof, 13 - 4 - 5 + 1);
}

TEST(TwoWay, OfRowsThatNothingJoinsIsOfEachApart)
{
    const TwoWayFit fit = fit_two_way(Table{{1, 2, nan, nan}, {2, 3, nan, nan}, {nan, nan, 9, 4}});
    EXPECT_NEAR(fit.columns[1] - fit.columns[0], 1, 1e-12);
    EXPECT_NEAR(fit.columns[3] - fit.columns[2], -5, 1e-12);
    EXPECT_EQ(fit.dof, 6 - 3 - 4 + 2);
}

/// 2000 tables of 5 × 8 with a third of the cells missing, noise 1: its square is right in the
/// mean, to 6 standard errors.
TEST(TwoWay, FindsTheNoiseWithoutBias)
{
    Random bits(5);
    std::normal_distribution<double> noise;
    double squares = 0, dof = 0;
    for (int run = 0; run < 2000; ++run) {
        Table table(5, std::vector<double>(8));
        for (auto& row : table)
            for (std::size_t c = 0; c < 8; ++c)
                row[c] = c > 1 && std::bernoulli_distribution(1.0 / 3)(bits)
                             ? nan
                             : 3.0 * static_cast<double>(c) + noise(bits);
        const TwoWayFit fit = fit_two_way(table);
        squares += fit.noise * fit.noise * fit.dof, dof += fit.dof;
    }
    EXPECT_NEAR(squares / dof, 1, 6 * std::sqrt(2 / dof));
}

}  // namespace
}  // namespace mis
