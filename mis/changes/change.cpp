#include "mis/changes/change.h"

#include "mis/math/limits.h"

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

constexpr double normal_quantile = 1.9599640;  // of that tail: the least that Student's t can have
constexpr double least_se = 1e-12;             // what doubles leave of a logarithm or a quotient
constexpr double mean_rounding = 4.8e-7;       // 4 ulp of float: samples are computed in it

double degrees(int observations) { return std::max(1.0, observations - 1.0); }

/// At most those of the figure's interval: Welch and Satterthwaite's are never below the least of
/// what they combine.
double least_degrees(ChangingFigure figure, const Reported& run)
{
    const bool has_times =
        figure == ChangingFigure::efficiency || figure == ChangingFigure::seconds_to_1_percent;
    return degrees(has_times ? std::min(run.replicates, run.report.timed_rounds) : run.replicates);
}

const Interval& stored(ChangingFigure figure, const StrategyReport& s)
{
    return figure == ChangingFigure::variance     ? s.variance
           : figure == ChangingFigure::efficiency ? s.efficiency
                                                  : s.seconds_to_1_percent;
}

/// Where one of the two is exact.
Change change_of_exact(bool is_efficiency, const StrategyReport& before,
                       const StrategyReport& after)
{
    const auto value = [&](const StrategyReport& s) {
        return is_efficiency ? s.exact ? infinity : s.efficiency.value
               : s.exact     ? 0
                             : s.variance.value;
    };
    Change change{.before = value(before), .after = value(after)};
    const bool grew = is_efficiency == after.exact;
    const double log_ratio = before.exact && after.exact ? 0 : grew ? infinity : -infinity;
    change.estimate = {log_ratio, 0, 1};
    change.by = interval_of(change.estimate);
    return change;
}

Change change_of_mean(const Reported& before, const Reported& after)
{
    const StrategyReport &b = before.report, &a = after.report;
    Change change{.before = b.mean, .after = a.mean};
    if (!std::isfinite(b.mean + a.mean + b.mean_se + a.mean_se)) return change;
    const double scale = std::max({std::fabs(b.mean), std::fabs(a.mean), b.mean_se, a.mean_se});
    if (scale == 0) return change.estimate = {0, 0, 1}, change.by = {0, 0, 0}, change;
    const auto part = [&](const Reported& run, double sign) {
        return LogEstimate{sign * (run.report.mean / scale),
                           std::max(run.report.mean_se / scale, least_se),
                           least_degrees(ChangingFigure::mean, run)};
    };
    const LogEstimate difference = product(part(after, 1), part(before, -1));
    const double se = std::hypot(difference.se, mean_rounding);
    change.estimate = {difference.value / se, 1, difference.dof};
    const double half_width = t_quantile(interval_tail, difference.dof);
    change.by = {change.estimate.value, change.estimate.value - half_width,
                 change.estimate.value + half_width};
    return change;
}

}  // namespace

LogEstimate log_of_stored(const Interval& figure, double dof)
{
    const double half_width =
        std::max(std::log(figure.high / figure.value), std::log(figure.value / figure.low));
    const double value = std::log(figure.value);
    if (!std::isfinite(value)) return {nan, nan, dof};
    if (!std::isfinite(half_width) || half_width < 0) return {value, nan, dof};
    return {value, std::max(half_width / normal_quantile, least_se), dof};
}

Change change_of(ChangingFigure figure, const Reported& before, const Reported& after)
{
    if (figure == ChangingFigure::mean) return change_of_mean(before, after);
    if (figure != ChangingFigure::seconds_to_1_percent &&
        (before.report.exact || after.report.exact))
        return change_of_exact(figure == ChangingFigure::efficiency, before.report, after.report);
    const Interval &of_before = stored(figure, before.report),
                   &of_after = stored(figure, after.report);
    Change change{.before = of_before.value, .after = of_after.value};
    LogEstimate earlier = log_of_stored(of_before, least_degrees(figure, before));
    earlier.value = -earlier.value;
    change.estimate = product(log_of_stored(of_after, least_degrees(figure, after)), earlier);
    change.by = interval_of(change.estimate);
    return change;
}

double p_of_no_regression(ChangingFigure figure, const Change& change, double worse_by)
{
    if (!change.is_compared() || figure == ChangingFigure::seconds_to_1_percent) return 1;
    if (figure == ChangingFigure::mean) return two_sided_p(change.estimate);
    LogEstimate cost = change.estimate;
    if (figure == ChangingFigure::efficiency) cost.value = -cost.value;
    return upper_p(cost, std::log1p(worse_by));
}

}  // namespace mis
