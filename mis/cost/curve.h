#pragma once

#include "mis/report/cost_report.h"
#include "mis/stats/estimate.h"
#include "mis/stats/measurements.h"

#include <span>
#include <vector>

namespace mis {

// From measured squared errors to a curve, its slope and the times to given errors. Pure arithmetic
// (docs/theory.md §22).

/// One doubling of one strategy. Replicates and levels have samples of their own.
struct CostLevel {
    std::uint64_t samples = 1;  ///< per point
    /// [replicate][region]: squared errors over μ² + ε²; over regions they sum to their mean over
    /// the shading points.
    RegionSums squared_errors;
    /// Likewise: mean squared distances of the samples from their own mean. Empty where the samples
    /// are independent.
    RegionSums spreads;
    Participation participation;  ///< of the squared errors, over points and replicates
    std::vector<double> seconds;  ///< [replicate]: CPU time of a point, with its preparation
};

/// What the reference adds to a mean relative squared error.
struct ReferenceError {
    double squared = 0;  ///< its own mean relative squared error, which is taken off
    double se = 0;       ///< of that
    double floor = 0;    ///< below this, squared errors are not trusted
};

/// All that was measured of one curve. Preconditions: all levels have as many replicates, at least
/// two, and regions.
struct CostMeasurements {
    Strategy strategy;
    Precision precision = Precision::in_float;
    CostReason reason;  ///< why there are no levels
    std::vector<CostLevel> levels;
    std::uint64_t invalid_samples = 0;
};

/// Where and on what the samples were taken.
struct CostGround {
    std::size_t points = 0;  ///< shading points that cost time; dark ones cost nothing
    int threads = 1;
    ReferenceError reference;
};

/// A squared error, its standard error and degrees of freedom (Student's t).
struct SquaredError {
    double value = 0, se = 0, dof = 1;
    Trust trust = Trust::trusted;
};

/// Mean relative squared error of a level, less the reference's.
SquaredError squared_error(const CostLevel& level, const ReferenceError& reference);

/// By how many times the variance of as many independent samples is larger (docs/theory.md (71)).
/// Unknown where the level has no spreads, or the reference does not tell its error.
Interval gain_of(const CostLevel& level, const ReferenceError& reference);

/// Would more doublings tell nothing that is asked for: after five, is the error past the smallest
/// of cost_targets, or were the last two below what the reference tells?
bool tells_no_more(const CostMeasurements& curve, const ReferenceError& reference);

/// What extrapolation and crossings go by: error² = V/n, and n samples of a point take one
/// preparation and n times a sample.
struct CostModel {
    LogEstimate log_variance;            ///< of V; NaN where nothing can be fitted
    std::vector<TimeObservation> times;  ///< [replicate]: fitted over the levels
    double points_per_thread = 1;
    double least_error = 0;  ///< that was fitted
};
CostModel model_of(const CostMeasurements& curve, const CostGround& ground);

/// Logarithm of the wall time that exp(log_samples) samples of every point take, at least 1
/// ((32) of docs/theory.md).
LogEstimate log_wall_seconds(const CostModel& model, const LogEstimate& log_samples);

/// Logarithm of the wall time until the error is `error`, by the model alone.
LogEstimate log_seconds_to(const CostModel& model, double error);

/// A slope whose p-value against −½ is below this does not fit.
inline constexpr double least_fit_p = 0.001;

CostCurveReport curve_report(const CostMeasurements& curve, const CostGround& ground);

}  // namespace mis
