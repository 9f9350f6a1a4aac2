#pragma once

#include "mis/cost/curve.h"

#include <span>
#include <vector>

namespace mis {

/// Errors below this are not looked at for crossings.
inline constexpr double least_crossing_error = 1e-3;

/// Where the leads of pairs of curves change, as far as that is sure: on either side of a crossing
/// one is the sooner to the same error, at 95 % for all pairs together (Bonferroni). Both have at
/// least one sample there. Models whose log_variance.value is NaN take no part. before and after
/// are indices of `models`.
std::vector<CrossingReport> find_crossings(std::span<const CostModel> models);

}  // namespace mis
