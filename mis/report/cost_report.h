#pragma once

#include "mis/report/report.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mis {

/// The number type that samples are computed in.
enum class Precision { in_float, in_double };

/// As it stands in files.
constexpr const char* name_of(Precision precision)
{
    return precision == Precision::in_double ? "double" : "float";
}

/// The relative errors that times are given for.
inline constexpr std::array cost_targets{0.1, 0.05, 0.02, 0.01, 0.005};

/// What a measured error is worth.
/// below_reference: it is smaller than what the reference is known to, or than floats tell;
/// rare_samples: fewer than `least_participation` squared errors carry it (stats/resolved.h).
enum class Trust { trusted, below_reference, rare_samples };

/// As it stands in files.
constexpr const char* name_of(Trust trust)
{
    constexpr std::array names{"trusted", "below_reference", "rare_samples"};
    return names[static_cast<std::size_t>(trust)];
}

/// One measured point of a curve.
struct CostPoint {
    std::uint64_t samples = 0;  ///< per shading point
    Interval error;             ///< root of the mean relative squared error
    Interval seconds;           ///< wall time on the stated threads, with preparation
    Trust trust = Trust::trusted;
    /// Of scrambled sequences: what as many independent samples have for variance, over theirs
    /// (docs/theory.md (71)). Unknown of independent samples and below the reference.
    Interval gain{std::numeric_limits<double>::quiet_NaN(),
                  std::numeric_limits<double>::quiet_NaN(),
                  std::numeric_limits<double>::quiet_NaN()};
};

/// measured: between two measured points, or 1 sample is enough; extrapolated: by error² = V/n,
/// beyond them or where few rare samples carry them; at_most: of scrambled sequences beyond them,
/// whose error falls at least as fast.
enum class Reach { measured, extrapolated, at_most, unknown };

/// As it stands in files.
constexpr const char* name_of(Reach reach)
{
    constexpr std::array names{"measured", "extrapolated", "at_most", "unknown"};
    return names[static_cast<std::size_t>(reach)];
}

/// When a relative error is reached.
struct TimeToError {
    double error = 0;    ///< one of cost_targets
    double samples = 0;  ///< per shading point, at least 1; NaN where unknown
    Interval seconds;    ///< wall time on the stated threads, with preparation;
                         ///< at_most: low is 0
    Reach reach = Reach::unknown;
};

/// All that was found about one strategy in one number type.
struct CostCurveReport {
    Strategy strategy;
    Precision precision = Precision::in_float;
    CostReason reason;              ///< why there are no points
    std::vector<CostPoint> points;  ///< by samples
    Interval slope;              ///< d log(error)/d log(samples): −½ for any unbiased estimate
    Interval slope_in_time;      ///< d log(error)/d log(seconds): steeper by what is
                                 ///< prepared
    double slope_p_value = 1;    ///< of −½ against the slope of the trusted points
    bool fits = true;            ///< error² = V/n holds as far as was measured
    Interval relative_variance;  ///< V: samples · error²
    Interval seconds_per_point, seconds_per_sample;  ///< CPU
    std::vector<TimeToError> times;                  ///< of cost_targets, in their order
    std::uint64_t invalid_samples = 0;
};

/// Two curves cross: up to `seconds` one strategy has the smaller error, from there on the other.
struct CrossingReport {
    int before = 0, after = 0;  ///< indices into CostSceneReport::curves
    Interval seconds, error;    ///< where; 95 % for all crossings of a scene together
    bool is_extrapolated = false;
};

/// What errors are measured against.
struct ReferenceReport {
    bool exact = false;                ///< from quadrature (`predict`)
    std::vector<std::string> sources;  ///< names of the strategies it is pooled from
    std::uint64_t samples = 0;         ///< per shading point, of the first source; 0 where exact
    double error = 0;    ///< root of its mean relative squared error; exact: a bound of it
    bool agrees = true;  ///< its sources differ by no more than their noise
};

struct CostSceneReport : SceneFacts {
    int replicates = 0;      ///< independent ones, of every point of a curve
    std::size_t copies = 1;  ///< of every shading point in a replicate: probes are few
    double epsilon = 0;      ///< of the relative error
    bool is_sobol = false;   ///< a replicate of a point is one scrambled sequence
    bool is_black = false;   ///< no sample of the reference met any light
    bool partial = false;
    double seconds = 0;  ///< wall
    std::optional<SetupSeconds> setup;
    ReferenceReport reference;
    std::vector<CostCurveReport> curves;
    std::vector<CrossingReport> crossings;
};

struct CostReport : RunHead {
    std::vector<CostSceneReport> scenes;
};

}  // namespace mis
