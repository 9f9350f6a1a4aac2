#pragma once

#include "mis/cost/curve.h"

#include <span>
#include <vector>

namespace mis {

/// The levels that lines are fitted to, by samples: all but those below the reference, so that none
/// is left out for an outlier that it met; none where fewer than `least_participation` squared
/// errors carry samples · error² of all of them together.
std::vector<const CostLevel*> fitted_levels(std::span<const CostLevel> levels,
                                            const ReferenceError& reference);

/// The levels that the slope is tested by: few rare samples make it anything.
std::vector<const CostLevel*> trusted_levels(std::span<const CostLevel> levels,
                                             const ReferenceError& reference);

/// Logarithm of V in error² = V/n: the mean of samples · error² over the levels, each counted
/// alike, so that no level is preferred for having come out low. NaN where there is no level, or V
/// is not above 0.
LogEstimate fitted_variance(std::span<const CostLevel* const> levels,
                            const ReferenceError& reference);

/// Seconds of a point that a replicate's levels share, and seconds per sample: least squares of the
/// relative deviations. What is shared is its preparation and whatever else a point takes once; of
/// one level, or where noise would leave nothing for a sample, 0. Precondition: at least one level.
TimeObservation fitted_time(std::span<const CostLevel> levels, std::size_t replicate);

/// What an error is drawn against.
enum class Against { samples, seconds };

/// Slope of log(error) by least squares, every level counted alike, with the jackknife's error over
/// the replicates (Miller 1974) and the reference's; `value` is the slope itself. NaN for fewer
/// than three levels.
LogEstimate fitted_slope(std::span<const CostLevel* const> levels, const ReferenceError& reference,
                         Against against);

/// value ± the 95 % half width; NaN bounds where the error is not known.
Interval linear_interval(const LogEstimate& estimate);

}  // namespace mis
