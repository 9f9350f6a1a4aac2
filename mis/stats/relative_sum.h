#pragma once

#include "mis/stats/measurements.h"

namespace mis {

/// Σ over points of V/(μ² + ε²), where V and μ are both estimated from the same directions: taken
/// to second order, so that it is not off by what these estimates have in common, nor by the
/// curvature of 1/(μ² + ε²) (docs/theory.md (87) and (88); Cochran
/// 1977, §6.4).
class RelativeSum {
public:
    explicit RelativeSum(double epsilon) : epsilon2_(epsilon * epsilon) {}

    /// covariance: of the two estimates.
    void add(const ValueAndError& variance, const ValueAndError& mean, double covariance);

    double value() const { return sum_ - correction_; }
    double se() const;
    /// By how much the second order moved the sum: a measure of what higher ones leave.
    double correction() const { return correction_; }

private:
    double epsilon2_, sum_ = 0, correction_ = 0, squared_error_ = 0;
};

}  // namespace mis
