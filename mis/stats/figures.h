#pragma once

#include "mis/report/strategy_report.h"
#include "mis/stats/estimate.h"
#include "mis/stats/measurements.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mis {

/// Samples per point for 1 % error = relative variance over this (the root of the mean relative
/// variance is 1 %).
inline constexpr double one_percent_squared = 1e-4;

/// What comparisons of one strategy take, in the form they take it.
struct Figures {
    bool exact = false;  ///< variance 0, proved
    double variance = 0, relative_variance = 0;
    bool is_shared = false;  ///< by directions that strategies share: replicates are turns of those
    std::vector<double> relative_variances;  ///< per replicate, where not
    LogEstimate relative_log;                ///< of the relative variance by itself: its error
    double relative_doubt = 0;  ///< half width, of its logarithm: what the estimated μ may do to it
    double signed_doubt = 0;    ///< the same with its sign, where is_shared
    RegionSums variances;       ///< per replicate and region
    RegionSums relative_by_region;      ///< the same of the relative variance, where is_shared
    std::vector<std::uint32_t> rounds;  ///< [observation of time]
    std::vector<double>
        seconds_at;  ///< per observation: seconds per sample, with its part of a point at n samples
    std::vector<double> seconds_to_1_percent;  ///< per observation: CPU seconds per point
    double samples_to_1_percent = 0;           ///< per point, at least 1
    double time_noise = 0,
           time_noise_dof = 0;  ///< standard deviation of log(an observation): remove_drift()
    double sampling_share = 0;  ///< d log(seconds to 1 %) / d log(relative variance)
};

/// Medians over observations of what a point takes once and what a sample takes, CPU seconds.
struct TimeIntervals {
    Interval per_point, per_sample;
};
TimeIntervals intervals_of(std::span<const TimeObservation> times);

/// What shared directions know of the relative variance's logarithm. NaN where it is not above 0.
LogEstimate relative_log(const SharedFigures& shared);

/// at: samples per point that a point's preparation is shared by.
Figures figures_of(const StrategyMeasurements& strategy, double at);

/// Takes out of the observed times what slowed all strategies of a round alike, of rounds that all
/// took part in, and finds the noise that is left, from all strategies together (two-way analysis
/// of variance of log(seconds)): a few rounds tell little of one strategy's noise, but much of all
/// strategies'. Does nothing for fewer than two rounds or strategies.
void remove_drift(std::span<Figures> figures);

/// Logarithm of a's variance over b's, over the same replicates. ∓∞ where one is exact, 0 where
/// both are.
LogEstimate log_variance_ratio(const Figures& a, const Figures& b);

/// Logarithm of a's variance × time over b's (efficiency turned over), times paired by round; of
/// two exact ones, of the times alone. A NaN value where times are missing.
LogEstimate log_cost_ratio(const Figures& a, const Figures& b);

/// Logarithm of a's time to 1 % error over b's. A NaN value where times are missing.
LogEstimate log_time_ratio(const Figures& a, const Figures& b);

/// Fills in what a report says of one strategy by itself, without comparison: all of its figures
/// but no status and rank. points: of the scene; threads: that the wall time to 1 % is for.
StrategyReport report_of(const StrategyMeasurements& strategy, const Figures& figures,
                         std::size_t points, int threads);

}  // namespace mis
