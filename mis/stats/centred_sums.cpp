#include "mis/stats/centred_sums.h"

#include <algorithm>
#include <numeric>

namespace mis {

double ReplicateSquares::squared_error(double n) const
{
    return std::max(squares / n - mean(n) * mean(n), 0.0) / (n - 1);
}

double squared_expectation(const std::array<double, shared_groups>& values)
{
    constexpr auto n = static_cast<double>(shared_groups);
    double sum = 0, squares = 0;
    for (const double x : values) sum += x, squares += x * x;
    return (sum * sum - squares) / (n * (n - 1));
}

double CentredSums::variance() const { return square_ / groups - squared_expectation(first_); }

double CentredSums::mean() const
{
    return std::accumulate(first_.begin(), first_.end(), 0.0) / groups + center_ * mass();
}

}  // namespace mis
