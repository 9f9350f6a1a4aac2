#include "mis/cost/curve.h"

#include "mis/cost/fit.h"
#include "mis/math/limits.h"
#include "mis/stats/bias.h"
#include "mis/stats/estimate.h"
#include "mis/stats/figures.h"
#include "mis/stats/resolved.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mis {
namespace {

/// Of the root of a squared error. Where the reference does not tell it, only an upper bound is
/// known, which is no lower than what the reference tells.
Interval error_interval(const SquaredError& e, const ReferenceError& reference)
{
    if (e.value > 0 && e.trust != Trust::below_reference)
        return interval_of({0.5 * std::log(e.value), 0.5 * e.se / e.value, e.dof});
    if (e.value == 0 && e.se == 0) return {0, 0, 0};  // to the last bit
    const double least =
        std::max({e.value, reference.floor, rounding_of_means * rounding_of_means});
    if (std::isnan(e.se)) return {std::sqrt(std::max(0.0, e.value)), nan, nan};
    const double high = least + (e.se > 0 ? t_quantile(interval_tail, e.dof) * e.se : 0);
    return {std::sqrt(std::max(0.0, e.value)), 0, std::sqrt(high)};
}

Interval scaled(Interval x, double factor)
{
    return {x.value * factor, x.low * factor, x.high * factor};
}

std::vector<double> seconds_of(std::span<const TimeObservation> times, double samples)
{
    std::vector<double> seconds;
    for (const TimeObservation& time : times) seconds.push_back(time.seconds_for(samples));
    return seconds;
}

CostPoint point_of(const CostLevel& level, const SquaredError& error, const CostGround& ground)
{
    return {.samples = level.samples,
            .error = error_interval(error, ground.reference),
            .seconds = scaled(interval_of_median(level.seconds),
                              static_cast<double>(ground.points) / ground.threads),
            .trust = error.trust,
            .gain = gain_of(level, ground.reference)};
}

/// Are all that were measured at one sample below `square`, whatever else is known of them?
bool is_one_enough(const CostLevel& level, const SquaredError& error, const CostGround& ground,
                   double square)
{
    return level.samples == 1 && error.trust != Trust::rare_samples &&
           std::max(error.value, ground.reference.floor) <= square;
}

/// A place between two levels.
struct Between {
    const CostLevel *before, *after;
    double part;              ///< of the way, in logarithms; in [0, 1]
    LogEstimate log_samples;  ///< there
};

/// Where the error falls to √square, between two trusted levels, from the last pair that has it
/// between them; nothing where none has. Errors of the levels are independent.
std::optional<Between> interpolated(std::span<const CostLevel> levels,
                                    std::span<const SquaredError> errors, double square)
{
    for (std::size_t k = levels.size(); k-- > 1;) {
        const SquaredError &a = errors[k - 1], &b = errors[k];
        if (a.trust != Trust::trusted || b.trust != Trust::trusted) continue;
        if (!(a.value > square && square >= b.value)) continue;
        const double fall = std::log(a.value / b.value), part = std::log(a.value / square) / fall,
                     step = std::log(double(levels[k].samples) / double(levels[k - 1].samples)),
                     per_log = step / fall;
        LogEstimate n = product({0, per_log * (1 - part) * a.se / a.value, a.dof},
                                {0, per_log * part * b.se / b.value, b.dof});
        n.value = std::log(double(levels[k - 1].samples)) + part * step;
        return Between{&levels[k - 1], &levels[k], part, n};
    }
    return std::nullopt;
}

/// Logarithm of the wall time there, from what the two levels took.
LogEstimate log_wall_seconds(const Between& at, const CostGround& ground)
{
    const LogEstimate a = log_median(at.before->seconds), b = log_median(at.after->seconds);
    const double step = std::log(double(at.after->samples) / double(at.before->samples));
    const LogEstimate clock = product({0, (1 - at.part) * a.se, a.dof}, {0, at.part * b.se, b.dof});
    LogEstimate wall =
        product(clock, {0, (b.value - a.value) / step * at.log_samples.se, at.log_samples.dof});
    wall.value = a.value + at.part * (b.value - a.value) +
                 std::log(static_cast<double>(ground.points) / ground.threads);
    return wall;
}

/// The first trusted level past √square, or else the last trusted one; nothing where none is.
const CostLevel* bounding_level(std::span<const CostLevel> levels,
                                std::span<const SquaredError> errors, double square)
{
    const CostLevel* found = nullptr;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        if (errors[k].trust != Trust::trusted) continue;
        found = &levels[k];
        if (errors[k].value <= square) break;
    }
    return found;
}

TimeToError time_to(double error, const CostMeasurements& curve,
                    std::span<const SquaredError> errors, const CostGround& ground,
                    const CostModel& model, const CostCurveReport& curve_found)
{
    const double square = error * error;
    TimeToError found{.error = error, .samples = nan, .seconds = unknown_interval()};
    const auto at = [&](const LogEstimate& samples, Reach reach) {
        found.samples = std::max(1.0, std::exp(samples.value));
        found.seconds = interval_of(log_wall_seconds(model, samples));
        found.reach = reach;
        return found;
    };
    if (curve.levels.empty()) return found;
    if (is_one_enough(curve.levels[0], errors[0], ground, square)) {
        found = at({0, 0, 1}, Reach::measured);
        found.seconds = curve_found.points[0].seconds;
        return found;
    }
    if (const std::optional<Between> between = interpolated(curve.levels, errors, square)) {
        found = at(between->log_samples, Reach::measured);
        const LogEstimate wall = log_wall_seconds(*between, ground);
        if (std::isfinite(wall.value)) found.seconds = interval_of(wall);
        return found;
    }
    if (std::isnan(model.log_variance.value)) return found;
    if (!curve.levels[0].spreads.empty()) {
        // The error of sequences falls at least as the root of their samples.
        const CostLevel* level = bounding_level(curve.levels, errors, square);
        if (level == nullptr || !(curve_found.fits || curve_found.slope.high < -0.5)) return found;
        const SquaredError& e = errors[static_cast<std::size_t>(level - curve.levels.data())];
        found = at({std::log(double(level->samples) * std::max(1.0, e.value / square)),
                    e.value > square ? e.se / e.value : 0, e.dof},
                   Reach::at_most);
        found.seconds.low = 0;
        return found;
    }
    if (!curve_found.fits) return found;
    LogEstimate beyond = model.log_variance;
    beyond.value -= std::log(square);
    return at(beyond, Reach::extrapolated);
}

}  // namespace

SquaredError squared_error(const CostLevel& level, const ReferenceError& reference)
{
    const LogEstimate raw = log_contrast(level.squared_errors, {});
    const double mean = std::exp(raw.value);
    SquaredError e{mean - reference.squared,
                   mean > 0 ? std::hypot(mean * raw.se, reference.se) : reference.se,
                   std::max(raw.dof, 1.0)};
    if (!(e.value > 0) || e.value < std::max(reference.floor, std::pow(rounding_of_means, 2)))
        e.trust = Trust::below_reference;
    else if (level.participation.number() < least_participation) e.trust = Trust::rare_samples;
    return e;
}

Interval gain_of(const CostLevel& level, const ReferenceError& reference)
{
    const SquaredError error = squared_error(level, reference);
    if (level.spreads.empty() || error.trust == Trust::below_reference) return unknown_interval();
    RegionSums one = level.squared_errors;  // of one independent sample: spread + error
    double spread = 0;
    for (std::size_t r = 0; r < one.size(); ++r)
        for (std::size_t g = 0; g < one[r].size(); ++g) {
            one[r][g] += level.spreads[r][g];
            spread += level.spreads[r][g] / static_cast<double>(one.size());
        }
    const LogEstimate ratio = log_contrast(one, level.squared_errors);
    const double gain = (spread + error.value) / (static_cast<double>(level.samples) * error.value);
    return interval_of({std::log(gain), std::hypot(ratio.se, reference.se / error.value),
                        std::max(ratio.dof, 1.0)});
}

bool tells_no_more(const CostMeasurements& curve, const ReferenceError& reference)
{
    constexpr std::size_t least_levels = 5;
    const std::size_t n = curve.levels.size();
    if (n < least_levels) return false;
    const SquaredError last = squared_error(curve.levels[n - 1], reference),
                       before = squared_error(curve.levels[n - 2], reference);
    if (last.trust == Trust::below_reference) return before.trust == last.trust;
    const double smallest = cost_targets.back();
    return last.trust == Trust::trusted && last.value < smallest * smallest;
}

namespace {

/// The same, so much longer or shorter that it is right for the longest level: what is extrapolated
/// goes on from there.
TimeObservation through_last(TimeObservation time, std::span<const CostLevel> levels,
                             std::size_t replicate)
{
    const CostLevel& last = levels.back();
    const double factor =
        last.seconds[replicate] / time.seconds_for(static_cast<double>(last.samples));
    if (!(factor > 0) || !std::isfinite(factor)) return time;
    time.seconds_per_sample *= factor, time.seconds_per_point *= factor;
    return time;
}

}  // namespace

CostModel model_of(const CostMeasurements& curve, const CostGround& ground)
{
    const std::vector<const CostLevel*> fitted = fitted_levels(curve.levels, ground.reference);
    CostModel model{.log_variance = fitted_variance(fitted, ground.reference),
                    .times = {},
                    .points_per_thread = static_cast<double>(ground.points) / ground.threads,
                    .least_error = std::numeric_limits<double>::infinity()};
    for (const CostLevel* level : fitted)
        model.least_error =
            std::min(model.least_error, std::sqrt(squared_error(*level, ground.reference).value));
    if (!curve.levels.empty())
        for (std::size_t r = 0; r < curve.levels[0].seconds.size(); ++r)
            model.times.push_back(through_last(fitted_time(curve.levels, r), curve.levels, r));
    return model;
}

LogEstimate log_wall_seconds(const CostModel& model, const LogEstimate& log_samples)
{
    const double samples = std::max(1.0, std::exp(log_samples.value));
    LogEstimate wall = log_median(seconds_of(model.times, samples));
    wall.value += std::log(model.points_per_thread);
    if (log_samples.value <= 0 || !(log_samples.se > 0)) return wall;
    double sampling = 0, all = 0;
    for (const TimeObservation& time : model.times) {
        sampling += samples * time.seconds_per_sample;
        all += time.seconds_for(samples);
    }
    const double share = all > 0 ? sampling / all : 1;
    return product(wall, {0, share * log_samples.se, log_samples.dof});
}

LogEstimate log_seconds_to(const CostModel& model, double error)
{
    LogEstimate samples = model.log_variance;
    samples.value -= 2 * std::log(error);
    return log_wall_seconds(model, samples);
}

CostCurveReport curve_report(const CostMeasurements& curve, const CostGround& ground)
{
    CostCurveReport report{.strategy = curve.strategy,
                           .precision = curve.precision,
                           .reason = curve.reason,
                           .points = {},
                           .slope = unknown_interval(),
                           .slope_in_time = unknown_interval(),
                           .relative_variance = unknown_interval(),
                           .seconds_per_point = unknown_interval(),
                           .seconds_per_sample = unknown_interval(),
                           .times = {},
                           .invalid_samples = curve.invalid_samples};
    std::vector<SquaredError> errors;
    for (const CostLevel& level : curve.levels) {
        errors.push_back(squared_error(level, ground.reference));
        report.points.push_back(point_of(level, errors.back(), ground));
    }
    const CostModel model = model_of(curve, ground);
    const std::vector<const CostLevel*> fitted = fitted_levels(curve.levels, ground.reference);
    const LogEstimate slope = fitted_slope(fitted, ground.reference, Against::samples);
    report.slope = linear_interval(slope);
    report.slope_in_time =
        linear_interval(fitted_slope(fitted, ground.reference, Against::seconds));
    report.slope_p_value = two_sided_p(fitted_slope(trusted_levels(curve.levels, ground.reference),
                                                    ground.reference, Against::samples),
                                       -0.5);
    report.fits = !(report.slope_p_value < least_fit_p);
    if (!std::isnan(model.log_variance.value) && (report.fits || curve.levels[0].spreads.empty()))
        report.relative_variance = interval_of(model.log_variance);
    const TimeIntervals times = intervals_of(model.times);
    report.seconds_per_point = times.per_point;
    report.seconds_per_sample = times.per_sample;
    for (const double error : cost_targets)
        report.times.push_back(time_to(error, curve, errors, ground, model, report));
    return report;
}

}  // namespace mis
