#include "mis/stats/figures.h"

#include "mis/math/limits.h"
#include "mis/math/stable.h"
#include "mis/stats/exactness.h"
#include "mis/stats/two_way.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mis {
namespace {

using Seconds = std::vector<double> Figures::*;

/// Without those of rounds that it took no part in.
std::vector<double> known(std::vector<double> seconds)
{
    std::erase_if(seconds, [](double s) { return std::isnan(s); });
    return seconds;
}

/// Logarithm of the ratio of the medians; its error from the rounds that both took part in, which a
/// drifting machine disturbed alike. Of fewer than six rounds, from the noise that all strategies
/// share, if it is known.
LogEstimate log_median_ratio(const Figures& a, const Figures& b, Seconds seconds)
{
    const std::vector<double>&of_a = a.*seconds, &of_b = b.*seconds;
    std::vector<double> logs;
    for (std::size_t i = 0; i < std::min(of_a.size(), of_b.size()); ++i)
        if (of_a[i] > 0 && of_b[i] > 0)
            logs.push_back(std::log(of_a[i] / of_b[i]));  // a coarse clock may say 0
    const double n = static_cast<double>(logs.size());
    LogEstimate paired = median(std::move(logs));
    paired.value = log_median(known(of_a)).value - log_median(known(of_b)).value;
    if (n >= 2 && n < 6 && a.time_noise_dof > 0) {
        const double of_a_median =
            n > 2 ? std::sqrt(0.5 * std::numbers::pi) : 1;  // against a mean, at most
        paired.se = of_a_median * std::hypot(a.time_noise, b.time_noise) / std::sqrt(n);
        paired.dof = a.time_noise_dof;
    }
    return paired;
}

/// Of one point, from its own observations. The interval is normal in the logarithm; none where
/// fewer than 30 of them carry the variance, as such a standard error means little. What is
/// rounding is no figure, but bounds one.
PointFigures point_figures(const Moments& moments, int samples_per_observation, bool is_exact)
{
    if (moments.count == 0) return {nan, nan, unknown_interval()};
    const double variance = moments.variance();
    const double of_rounding = std::pow(rounding_of_samples * moments.mean, 2);
    if (variance > 0 && variance <= of_rounding)
        return {moments.mean, moments.mean_se(), {0, 0, is_exact ? 0 : of_rounding}};
    const bool known = moments.effective_count() >= 30;
    const double se = moments.m2 == 0 ? 0
                      : known         ? moments.variance_se() / variance
                                      : std::numeric_limits<double>::quiet_NaN();
    return {moments.mean, moments.mean_se(),
            interval_about(samples_per_observation * variance, {0, se, 1e6})};
}

void add_times(StrategyReport& report, const StrategyMeasurements& s, const Figures& figures)
{
    report.timed_rounds = static_cast<int>(known(figures.seconds_at).size());
    const TimeIntervals times = intervals_of(s.times);
    report.seconds_per_sample = times.per_sample;
    report.seconds_per_point = times.per_point;
    const double samples = static_cast<double>(std::max<std::uint64_t>(s.pooled.samples, 1));
    for (const auto& [stage, seconds] : s.stage_seconds)
        report.stage_seconds[stage] = seconds / samples;
    report.rays_per_sample = static_cast<double>(s.rays) / samples;
    const LogEstimate seconds = log_median(known(figures.seconds_at));
    if (figures.exact) {
        report.efficiency =
            std::isnan(seconds.value) ? unknown_interval() : Interval{infinity, infinity, infinity};
        return;
    }
    LogEstimate cost = product(log_contrast(figures.variances, {}), seconds);
    report.efficiency = interval_about(inverse(figures.variance * std::exp(seconds.value)), cost);
}

}  // namespace

TimeIntervals intervals_of(std::span<const TimeObservation> times)
{
    std::vector<double> per_point, per_sample;
    for (const TimeObservation& time : times) {
        if (!time.is_known()) continue;
        per_point.push_back(time.seconds_per_point);
        per_sample.push_back(time.seconds_per_sample);
    }
    return {interval_of_median(per_point), interval_of_median(per_sample)};
}

Figures figures_of(const StrategyMeasurements& s, double at)
{
    Figures f;
    f.exact = s.all_samples_equal_reference;
    f.variance = f.exact ? 0 : s.pooled.variance;
    f.relative_variance = f.exact ? 0 : s.pooled.relative_variance;
    if (f.relative_variance > 0)
        f.relative_doubt = std::log1p(s.pooled.relative_variance_doubt / f.relative_variance);
    const double least_samples =
        s.samples_per_observation;  // a part of a scrambling was not measured
    f.samples_to_1_percent = std::max(least_samples, f.relative_variance / one_percent_squared);
    for (const ReplicateValues& replicate : s.replicates) {
        f.variances.push_back({replicate.variance});
        f.relative_variances.push_back(replicate.relative_variance);
    }
    if (s.region_variances.size() == s.replicates.size()) f.variances = s.region_variances;
    for (const TimeObservation& time : s.times) {
        f.seconds_at.push_back(time.seconds_per_sample + time.seconds_per_point / at);
        f.seconds_to_1_percent.push_back(time.seconds_for(f.samples_to_1_percent));
    }
    if (f.samples_to_1_percent > least_samples && !s.times.empty()) {
        double sampling = 0, all = 0;
        for (std::size_t i = 0; i < s.times.size(); ++i) {
            if (!s.times[i].is_known()) continue;
            sampling += f.samples_to_1_percent * s.times[i].seconds_per_sample;
            all += f.seconds_to_1_percent[i];
        }
        f.sampling_share = all > 0 ? sampling / all : 1;
    }
    return f;
}

void remove_drift(std::span<Figures> figures)
{
    std::vector<Figures*> timed;
    std::vector<std::vector<double>> logs;
    for (Figures& f : figures) {
        const std::vector<double> seconds = known(f.seconds_at);
        if (seconds.size() < 2 || std::ranges::any_of(seconds, [](double s) { return s <= 0; }))
            continue;
        timed.push_back(&f);
        logs.emplace_back();
        for (const double s : f.seconds_at) logs.back().push_back(std::log(s));
    }
    if (timed.size() < 2) return;
    const TwoWayFit fit = fit_two_way(logs);
    if (fit.dof < 1) return;
    for (Figures* f : timed) {
        f->time_noise = fit.noise;
        f->time_noise_dof = fit.dof;
        for (std::size_t i = 0; i < f->seconds_at.size(); ++i) {
            const double slower = std::exp(fit.columns[i]);
            f->seconds_at[i] /= slower;
            f->seconds_to_1_percent[i] /= slower;
        }
    }
}

LogEstimate log_variance_ratio(const Figures& a, const Figures& b)
{
    if (a.exact || b.exact) return {a.exact && b.exact ? 0 : a.exact ? -infinity : infinity, 0, 1};
    LogEstimate ratio = log_contrast(a.variances, b.variances);
    ratio.value = std::log(a.variance / b.variance);
    return ratio;
}

LogEstimate log_cost_ratio(const Figures& a, const Figures& b)
{
    const LogEstimate variance = log_variance_ratio(a, b),
                      seconds = log_median_ratio(a, b, &Figures::seconds_at);
    if (std::isnan(seconds.value)) return seconds;
    return std::isinf(variance.value) ? variance : product(variance, seconds);
}

LogEstimate log_time_ratio(const Figures& a, const Figures& b)
{
    const std::size_t n = std::min(a.relative_variances.size(), b.relative_variances.size());
    LogEstimate samples = log_contrast(std::span(a.relative_variances).first(n), a.sampling_share,
                                       std::span(b.relative_variances).first(n), b.sampling_share);
    samples.value = 0;  // is in the seconds already
    // What the estimated means may do to either: a bound, taken for two standard errors.
    const double doubt =
        std::hypot(a.relative_doubt * a.sampling_share, b.relative_doubt * b.sampling_share);
    samples = product(samples, {0, 0.5 * doubt, 1e6});
    return product(samples, log_median_ratio(a, b, &Figures::seconds_to_1_percent));
}

StrategyReport report_of(const StrategyMeasurements& s, const Figures& figures, std::size_t points,
                         int threads)
{
    StrategyReport report;
    report.strategy = s.strategy;
    report.exact = figures.exact;
    report.samples = s.pooled.samples;
    report.invalid_samples = s.invalid_samples;
    if (s.invalid_samples > 0) report.first_invalid = s.first_invalid;
    if (!s.was_run) {
        report.estimated_seconds = s.estimated_seconds;
        report.mean = report.mean_se = report.rays_per_sample = unknown_interval().value;
        report.variance = report.relative_variance = report.seconds_per_point =
            report.seconds_per_sample = report.efficiency = report.seconds_to_1_percent =
                unknown_interval();
        return report;
    }
    std::vector<double> means;
    for (const ReplicateValues& replicate : s.replicates) means.push_back(replicate.mean);
    report.mean = s.pooled.mean;
    report.mean_se = figures.exact ? 0 : mean_and_error(means).se;
    report.variance = figures.exact
                          ? Interval{}
                          : interval_about(figures.variance, log_contrast(figures.variances, {}));
    report.relative_variance = figures.exact
                                   ? Interval{}
                                   : widened(interval_about(figures.relative_variance,
                                                            log_mean(figures.relative_variances)),
                                             figures.relative_doubt);
    report.rare_share = figures.exact ? 0 : s.pooled.rare_share;
    report.effective_samples = s.pooled.participation.number();
    add_times(report, s, figures);
    const LogEstimate cpu_seconds = log_median(known(figures.seconds_to_1_percent));
    LogEstimate to_1_percent = product(
        log_contrast(figures.relative_variances, figures.sampling_share, {}, 0), cpu_seconds);
    report.seconds_to_1_percent =
        widened(interval_about(std::exp(cpu_seconds.value) * static_cast<double>(points) / threads,
                               to_1_percent),
                figures.relative_doubt * figures.sampling_share);
    for (const Moments& probe : s.probes)
        report.probes.push_back(point_figures(probe, s.samples_per_observation, figures.exact));
    return report;
}

}  // namespace mis
