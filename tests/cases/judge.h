#pragma once

#include "mis/math/moments.h"
#include "mis/predict/predict.h"

#include <string>

namespace mis {

/// How strict to be.
struct Strictness {
    double false_alarm;  ///< of one test, two-sided
    double rounding;     ///< relative error that rounding may make of one sample
};

/// Samples per kurtosis from which on a mean is near enough to normal, and a variance.
inline constexpr double mean_needs = 100, variance_needs = 1000;

/// What of `measured` cannot be, if `predicted` is true; empty if nothing. Tested are
/// - the mean: by a normal bound, corrected for skewness, where n ≥ mean_needs · kurtosis; by
///   what holds for any distribution elsewhere;
/// - the variance, where n ≥ variance_needs · kurtosis.
/// Both allow for the prediction's own error and for rounding.
std::string disagreement(const Moments& measured, const Predicted& predicted,
                         const Strictness& strictness);

/// The z that the mean of n samples exceeds with probability `p`, to the accuracy of Cramér's
/// expansion, where q = kurtosis/n: log p = log Q(z) + √q z³/6 + q z⁴/24. √q bounds the skewness of
/// the mean, as skewness² < kurtosis; q its excess. Source: Petrov 1975, "Sums of Independent
/// Random Variables", chapter VIII.
double skewed_z_bound(double p, double q);

}  // namespace mis
