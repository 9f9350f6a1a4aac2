#include "mis/stats/relative_sum.h"

#include <algorithm>
#include <cmath>

namespace mis {

void RelativeSum::add(const ValueAndError& variance, const ValueAndError& mean, double covariance)
{
    const double v = variance.value, mu = mean.value, square = mu * mu + epsilon2_;
    if (!(square > 0)) return;
    const double by_variance = 1 / square, by_mean = -2 * v * mu / square / square,
                 by_both = -2 * mu / square / square,
                 by_mean_twice = v * (8 * mu * mu / square - 2) / square / square;
    sum_ += v / square;
    correction_ += 0.5 * by_mean_twice * mean.se * mean.se + by_both * covariance;
    squared_error_ +=
        std::max(0.0, std::pow(by_variance * variance.se, 2) + std::pow(by_mean * mean.se, 2) +
                          2 * by_variance * by_mean * covariance);
}

double RelativeSum::se() const { return std::sqrt(squared_error_); }

}  // namespace mis
