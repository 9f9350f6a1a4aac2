#pragma once

#include "mis/report/interval.h"

#include <span>
#include <vector>

namespace mis {

/// The logarithm of the product of two independent figures; degrees of freedom after Welch (1947)
/// and Satterthwaite (1946).
LogEstimate product(const LogEstimate& a, const LogEstimate& b);

/// Of one over the figure.
LogEstimate turned_over(LogEstimate estimate);

/// weight_a·log(mean of a) − weight_b·log(mean of b), over the same replicates; each half only
/// where its weight is not 0. The error is the jackknife's over the replicates (Miller 1974). It is
/// that of the logarithm of the mean, where the mean of the replicates' logarithms would be too low
/// by half their squared spread, so that the noisier strategy would win; and a replicate of 0 does
/// no harm. Unknown for fewer than two replicates, or if all but one are 0.
LogEstimate log_contrast(std::span<const double> a, double weight_a, std::span<const double> b,
                         double weight_b);

/// A figure of each replicate as a sum over regions, [replicate][region]; regions' samples are
/// independent.
using RegionSums = std::vector<std::vector<double>>;

/// weight_a·log(mean of a) − weight_b·log(mean of b), over the same replicates and regions; `b` may
/// be empty, for log(mean of a) alone. The error is added up region by region, which makes far more
/// degrees of freedom than the replicates' totals have (docs/theory.md, §15; Satterthwaite 1946):
/// the samples of one region say nothing of another's. Unknown for fewer than two replicates or a
/// mean of 0.
LogEstimate log_contrast(const RegionSums& a, double weight_a, const RegionSums& b,
                         double weight_b);
/// With weights of 1.
inline LogEstimate log_contrast(const RegionSums& a, const RegionSums& b)
{
    return log_contrast(a, 1, b, 1);
}

/// log(mean of replicates), with its jackknife error.
LogEstimate log_mean(std::span<const double> replicates);

/// The median of `values`, with a standard error from the distribution-free interval between two of
/// them (David and Nagaraja 2003, §7.1): what disturbs a clock is one-sided and large. Fewer than
/// six: from Student's t.
LogEstimate median(std::vector<double> values);

/// Logarithm of the median of `values`; a NaN value where that is not above 0.
LogEstimate log_median(const std::vector<double>& values);

/// The median and its 95 % interval, not below 0; NaN bounds where the error is not known.
Interval interval_of_median(std::vector<double> values);

/// Is the figure, whose logarithm this is, at least three of its standard errors above 0? Else its
/// logarithm says little.
bool is_above_errors(const LogEstimate& log_figure);

/// P(|T| ≥ |value − at| / se): how surprising the estimate is if the truth is `at`. 1 where the
/// error is not known.
double two_sided_p(const LogEstimate& estimate, double at = 0);

/// P(T ≥ (value − at) / se): how surprising the estimate is if the truth is `at` or below. 1 where
/// the error is not known.
double upper_p(const LogEstimate& estimate, double at);

/// P(T ≥ t) of Student's t.
double upper_tail(double t, double dof);

/// The share of each side outside an interval of 95 %.
inline constexpr double interval_tail = 0.025;

/// The t that is exceeded with probability `tail`.
double t_quantile(double tail, double dof);

/// exp of the estimate and of its 95 % interval; NaN bounds where the error is not known.
Interval interval_of(const LogEstimate& log_figure);

/// The same interval about another centre: the figure pooled over all samples, not the mean of the
/// replicates'.
Interval interval_about(double centre, const LogEstimate& log_figure);

/// With another, independent half width of its logarithm.
Interval widened(const Interval& interval, double half_width);

/// Not known.
Interval unknown_interval();

/// Mean of some numbers, and its standard error (NaN for fewer than two).
struct MeanAndError {
    double mean = 0, se = 0;
};
MeanAndError mean_and_error(std::span<const double> values);

}  // namespace mis
