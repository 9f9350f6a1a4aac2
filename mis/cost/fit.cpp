#include "mis/cost/fit.h"

#include "mis/math/limits.h"
#include "mis/math/moments.h"
#include "mis/stats/estimate.h"
#include "mis/stats/resolved.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mis {
namespace {

/// Mean of `values`, without the one at `left_out`, if any.
double mean_without(std::span<const double> values, std::size_t left_out)
{
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (i != left_out) sum += values[i], ++count;
    return sum / count;
}

/// What least squares multiplies each y with for the slope over x.
std::vector<double> slope_weights(std::span<const double> x)
{
    const double mean = mean_without(x, x.size());
    std::vector<double> weights;
    double squares = 0;
    for (const double each : x) {
        weights.push_back(each - mean);
        squares += (each - mean) * (each - mean);
    }
    for (double& w : weights) w /= squares;
    return weights;
}

/// One level as a line is fitted to it: a value per replicate.
struct Observed {
    double samples;
    std::vector<double> squared_errors, seconds;
};

std::vector<Observed> observed(std::span<const CostLevel* const> levels)
{
    std::vector<Observed> all;
    for (const CostLevel* level : levels) {
        Observed o{
            .samples = static_cast<double>(level->samples), .squared_errors = {}, .seconds = {}};
        for (const std::vector<double>& replicate : level->squared_errors)
            o.squared_errors.push_back(std::accumulate(replicate.begin(), replicate.end(), 0.0));
        o.seconds = level->seconds;
        all.push_back(std::move(o));
    }
    return all;
}

/// x and y of every level, without one replicate.
struct Line {
    std::vector<double> weights, logs;

    Line(std::span<const Observed> levels, double reference, Against against, std::size_t left_out)
    {
        std::vector<double> x;
        for (const Observed& level : levels) {
            x.push_back(std::log(against == Against::samples
                                     ? level.samples
                                     : mean_without(level.seconds, left_out)));
            logs.push_back(0.5 *
                           std::log(mean_without(level.squared_errors, left_out) - reference));
        }
        weights = slope_weights(x);
    }
    double slope() const
    {
        return std::inner_product(weights.begin(), weights.end(), logs.begin(), 0.0);
    }
};

}  // namespace

std::vector<const CostLevel*> fitted_levels(std::span<const CostLevel> levels,
                                            const ReferenceError& reference)
{
    std::vector<const CostLevel*> fitted;
    Participation all;
    for (const CostLevel& level : levels) {
        if (squared_error(level, reference).trust == Trust::below_reference) continue;
        const double n = static_cast<double>(level.samples);
        all.sum_d2 += n * level.participation.sum_d2;
        all.sum_d4 += n * n * level.participation.sum_d4;
        fitted.push_back(&level);
    }
    if (all.number() < least_participation) fitted.clear();
    return fitted;
}

std::vector<const CostLevel*> trusted_levels(std::span<const CostLevel> levels,
                                             const ReferenceError& reference)
{
    std::vector<const CostLevel*> trusted;
    for (const CostLevel& level : levels)
        if (squared_error(level, reference).trust == Trust::trusted) trusted.push_back(&level);
    return trusted;
}

LogEstimate fitted_variance(std::span<const CostLevel* const> levels,
                            const ReferenceError& reference)
{
    if (levels.empty()) return {nan, nan, 1};
    const double share = 1 / static_cast<double>(levels.size());
    double mean_samples = 0;
    RegionSums sums = levels[0]->squared_errors;
    for (std::vector<double>& replicate : sums) std::fill(replicate.begin(), replicate.end(), 0.0);
    for (const CostLevel* level : levels) {
        const double weight = share * static_cast<double>(level->samples);
        mean_samples += weight;
        for (std::size_t r = 0; r < sums.size(); ++r)
            for (std::size_t g = 0; g < sums[r].size(); ++g)
                sums[r][g] += weight * level->squared_errors[r][g];
    }
    const LogEstimate raw = log_contrast(sums, {});
    const double value = std::exp(raw.value) - mean_samples * reference.squared;
    if (!(value > 0)) return {nan, nan, 1};
    const double se = std::hypot(std::exp(raw.value) * raw.se, mean_samples * reference.se);
    return {std::log(value), se / value, raw.dof};
}

TimeObservation fitted_time(std::span<const CostLevel> levels, std::size_t replicate)
{
    // Σ ((a + b n)/y − 1)² is least; with u = 1/y, v = n/y.
    double uu = 0, uv = 0, vv = 0, u = 0, v = 0;
    for (const CostLevel& level : levels) {
        const double y = level.seconds[replicate];
        if (!(y > 0)) continue;  // a coarse clock
        const double n = static_cast<double>(level.samples);
        uu += 1 / (y * y), uv += n / (y * y), vv += n * n / (y * y), u += 1 / y, v += n / y;
    }
    if (!(vv > 0)) return {};
    const double determinant = uu * vv - uv * uv;
    const double shared = determinant > 1e-9 * uu * vv ? (u * vv - v * uv) / determinant : 0;
    const double per_sample = shared > 0 ? (uu * v - uv * u) / determinant : 0;
    // A sample takes some time, whatever a noisy clock says of two short levels.
    return per_sample > 0 ? TimeObservation{per_sample, shared} : TimeObservation{v / vv, 0};
}

LogEstimate fitted_slope(std::span<const CostLevel* const> levels, const ReferenceError& reference,
                         Against against)
{
    if (levels.size() < 3) return {nan, nan, 1};
    const std::vector<Observed> all = observed(levels);
    const std::size_t replicates = all[0].squared_errors.size();
    const Line line(all, reference.squared, against, replicates);
    std::vector<double> slopes;
    for (std::size_t r = 0; r < replicates; ++r)
        slopes.push_back(Line(all, reference.squared, against, r).slope());
    const double n = static_cast<double>(replicates);
    const double squares =
        (n - 1) / n * Moments::of(std::span<const double>(slopes)).m2;  // the jackknife's
    double of_reference = 0;  // the same reference under every level
    for (std::size_t k = 0; k < all.size(); ++k)
        of_reference += 0.5 * line.weights[k] * reference.se * std::exp(-2 * line.logs[k]);
    return {line.slope(), std::sqrt(squares + of_reference * of_reference), n - 1};
}

Interval linear_interval(const LogEstimate& estimate)
{
    if (!(estimate.se >= 0)) return {estimate.value, nan, nan};
    const double half_width =
        estimate.se > 0 ? t_quantile(interval_tail, estimate.dof) * estimate.se : 0;
    return {estimate.value, estimate.value - half_width, estimate.value + half_width};
}

}  // namespace mis
