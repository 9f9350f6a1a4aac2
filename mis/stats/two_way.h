#pragma once

#include <span>
#include <vector>

namespace mis {

/// The sum of a row's and a column's effect that is nearest to a table, in the squares, and what is
/// left. Cells may be missing.
struct TwoWayFit {
    std::vector<double> columns;  ///< their effects, 0 in the mean; 0 of a column without cells
    double noise = 0;             ///< standard deviation of what is left in a cell
    double dof = 0;               ///< of it
};

/// Two-way analysis of variance of table[row][column] (Yates 1934): NaN is a missing cell, and so
/// is what a shorter row lacks. Rows that no chain of common columns joins say nothing of one
/// another.
TwoWayFit fit_two_way(std::span<const std::vector<double>> table);

}  // namespace mis
