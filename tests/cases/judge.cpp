#include "tests/cases/judge.h"

#include "mis/math/stable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mis {

double skewed_z_bound(double p, double q)
{
    const auto log_tail = [&](double z) {
        return std::log(std::erfc(z / std::sqrt(2.0)) / 2) + std::sqrt(q) * z * z * z / 6 +
               q * z * z * z * z / 24;
    };
    double low = 0, high = 12;
    for (int i = 0; i < 60; ++i) {
        const double z = (low + high) / 2;
        (log_tail(z) > std::log(p) ? low : high) = z;
    }
    return high;
}

namespace {

/// How far below and above the truth a figure may be.
struct Room {
    double below, above;
};

/// Of the mean of n samples, in standard errors of it, at probability p on either side.
Room room_of_mean(double n, double kurtosis, double relative_variance, double p)
{
    // Of numbers that are never negative, the mean is not far too low: P ≤ exp(−n t²/(2 E[X²])), as
    // e^{−x} ≤ 1 − x + x²/2. For the other side the fourth moment is all that is known.
    const double any_below = std::sqrt(-2 * std::log(p) * (1 + inverse(relative_variance)));
    const double any_above = std::pow((3 + kurtosis / n) / p, 0.25);
    if (n < mean_needs * kurtosis) return {std::min(any_below, any_above), any_above};
    const double z = skewed_z_bound(p, kurtosis / n);
    return {std::min(any_below, z), z};
}

std::string outside(const char* what, double value, double low, double high)
{
    if (value >= low && value <= high) return {};
    return fmt::format("{} {:.9g} is not in [{:.9g}, {:.9g}]; ", what, value, low, high);
}

}  // namespace

std::string disagreement(const Moments& measured, const Predicted& predicted,
                         const Strictness& strictness)
{
    const double n = static_cast<double>(measured.count), p = strictness.false_alarm / 2;
    const double mean = predicted.mean, variance = predicted.variance;
    const double rounding = strictness.rounding * mean + predicted.mean_error;
    // A variance that its own error covers is that of rounding.
    const bool is_constant = variance <= 10 * predicted.variance_error;
    if (is_constant && !(variance + predicted.variance_error <= square(strictness.rounding * mean)))
        return fmt::format("variance {:.3g} is not known: ±{:.3g}; ", variance,
                           predicted.variance_error);
    if (is_constant)
        return outside("mean", measured.mean, mean - 2 * rounding, mean + 2 * rounding) +
               outside("deviation", std::sqrt(measured.variance()), 0,
                       2 * strictness.rounding * mean);
    // No kurtosis is below 1, which two values drawn equally often have; rounding may say less.
    const double kurtosis = std::max(predicted.fourth / square(variance), 1.0);
    const Room room = room_of_mean(n, kurtosis, variance / square(mean), p);
    const double error_of_mean = std::sqrt(variance / n);
    std::string found = outside("mean", measured.mean, mean - room.below * error_of_mean - rounding,
                                mean + room.above * error_of_mean + rounding);
    if (n < variance_needs * kurtosis) return found;
    // Of s², with what the mean's own error takes away. Values that are off by a share e each have
    // a deviation that is off by e √E[X²] at most (Minkowski's inequality).
    const double z = skewed_z_bound(p, 1 / variance_needs);
    const double spread =
        variance * (z * std::sqrt((kurtosis - 1) / n) + z * z / n) + predicted.variance_error;
    const double off = strictness.rounding * std::sqrt(variance + square(mean));
    return found + outside("deviation", std::sqrt(measured.variance()),
                           std::sqrt(std::max(variance - spread, 0.0)) - off,
                           std::sqrt(variance + spread) + off);
}

}  // namespace mis
