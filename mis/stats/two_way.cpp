#include "mis/stats/two_way.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace mis {
namespace {

/// One column: its rows that have a cell, and their mean.
struct TableColumn {
    std::vector<std::size_t> rows;
    double mean = 0;
};

std::vector<TableColumn> columns_of(std::span<const std::vector<double>> table)
{
    std::size_t count = 0;
    for (const std::vector<double>& row : table) count = std::max(count, row.size());
    std::vector<TableColumn> columns(count);
    for (std::size_t r = 0; r < table.size(); ++r)
        for (std::size_t c = 0; c < table[r].size(); ++c) {
            if (std::isnan(table[r][c])) continue;
            columns[c].rows.push_back(r);
            columns[c].mean += table[r][c];
        }
    for (TableColumn& column : columns)
        if (!column.rows.empty()) column.mean /= static_cast<double>(column.rows.size());
    return columns;
}

/// Linear equations for the rows' effects, once the columns' are eliminated.
class RowEquations {
public:
    RowEquations(std::span<const std::vector<double>> table,
                 const std::vector<TableColumn>& columns)
        : n_(table.size()), matrix_(n_, std::vector<double>(n_, 0.0)), right_(n_, 0.0)
    {
        for (std::size_t c = 0; c < columns.size(); ++c)
            for (const std::size_t r : columns[c].rows) {
                matrix_[r][r] += 1;
                right_[r] += table[r][c] - columns[c].mean;
                for (const std::size_t other : columns[c].rows)
                    matrix_[r][other] -= 1 / static_cast<double>(columns[c].rows.size());
            }
    }

    /// The effects, and how many of them are free: one of those that are joined.
    std::pair<std::vector<double>, int> solve() &&
    {
        int free = 0;
        for (std::size_t k = n_; k-- > 0;) {  // the matrix is not negative: no pivot is sought
            if (!(matrix_[k][k] > 1e-9)) {
                ++free;
                matrix_[k].assign(n_, 0.0);
                matrix_[k][k] = 1, right_[k] = 0;
                continue;
            }
            for (std::size_t r = 0; r < k; ++r) subtract(r, matrix_[r][k] / matrix_[k][k], k);
        }
        std::vector<double> effects(n_);
        for (std::size_t r = 0; r < n_; ++r) {
            double rest = right_[r];
            for (std::size_t c = 0; c < r; ++c) rest -= matrix_[r][c] * effects[c];
            effects[r] = rest / matrix_[r][r];
        }
        return {effects, free};
    }

private:
    void subtract(std::size_t row, double factor, std::size_t pivot)
    {
        for (std::size_t c = 0; c <= pivot; ++c) matrix_[row][c] -= factor * matrix_[pivot][c];
        right_[row] -= factor * right_[pivot];
    }

    std::size_t n_;
    std::vector<std::vector<double>> matrix_;
    std::vector<double> right_;
};

}  // namespace

TwoWayFit fit_two_way(std::span<const std::vector<double>> table)
{
    const std::vector<TableColumn> columns = columns_of(table);
    const auto [rows, free] = RowEquations(table, columns).solve();
    TwoWayFit fit{std::vector<double>(columns.size(), 0.0)};
    double squares = 0, cells = 0, filled = 0, sum = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const auto& in = columns[c].rows;
        if (in.empty()) continue;
        double of_rows = 0;
        for (const std::size_t r : in) of_rows += rows[r] / static_cast<double>(in.size());
        fit.columns[c] = columns[c].mean - of_rows;
        for (const std::size_t r : in)
            squares += std::pow(table[r][c] - rows[r] - fit.columns[c], 2);
        cells += static_cast<double>(in.size()), ++filled, sum += fit.columns[c];
    }
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (!columns[c].rows.empty()) fit.columns[c] -= sum / filled;
    fit.dof = cells - static_cast<double>(table.size()) - filled + free;
    fit.noise = fit.dof > 0 ? std::sqrt(squares / fit.dof) : 0;
    return fit;
}

}  // namespace mis
