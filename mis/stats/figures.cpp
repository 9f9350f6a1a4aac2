#include "mis/stats/figures.h"

#include "mis/math/limits.h"
#include "mis/math/stable.h"
#include "mis/stats/exactness.h"
#include "mis/stats/two_way.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace mis {
namespace {

using Seconds = std::vector<double> Figures::*;

/// Places of the rounds that both took part in.
std::vector<std::pair<std::size_t, std::size_t>> common_rounds(const Figures& a, const Figures& b)
{
    std::vector<std::pair<std::size_t, std::size_t>> common;
    for (std::size_t i = 0, j = 0; i < a.rounds.size() && j < b.rounds.size();) {
        if (a.rounds[i] == b.rounds[j]) common.emplace_back(i, j);
        const bool is_first_behind = a.rounds[i] <= b.rounds[j];
        if (b.rounds[j] <= a.rounds[i]) ++j;
        if (is_first_behind) ++i;
    }
    return common;
}

/// Logarithm of the ratio of the medians over the rounds that both took part in, which a drifting
/// machine disturbed alike; of all where there are not two such. Its error, of fewer than six
/// rounds, is from the noise that all strategies share, if it is known.
LogEstimate log_median_ratio(const Figures& a, const Figures& b, Seconds seconds)
{
    const auto common = common_rounds(a, b);
    if (common.size() < 2)
        return product(log_median(a.*seconds), turned_over(log_median(b.*seconds)));
    std::vector<double> of_a, of_b, logs;
    for (const auto& [i, j] : common) {
        of_a.push_back((a.*seconds)[i]);
        of_b.push_back((b.*seconds)[j]);
        if (of_a.back() > 0 && of_b.back() > 0)
            logs.push_back(std::log(of_a.back() / of_b.back()));  // a coarse clock may say 0
    }
    const double n = static_cast<double>(logs.size());
    LogEstimate paired = median(std::move(logs));
    paired.value = log_median(of_a).value - log_median(of_b).value;
    if (n >= 2 && n < 6 && a.time_noise_dof > 0) {
        const double of_a_median =
            n > 2 ? std::sqrt(0.5 * std::numbers::pi) : 1;  // against a mean, at most
        paired.se = of_a_median * std::hypot(a.time_noise, b.time_noise) / std::sqrt(n);
        paired.dof = a.time_noise_dof;
    }
    return paired;
}

/// Of a's variance over b's, where neither is exact. Turns of shared directions say nothing of
/// replicates of own samples.
LogEstimate variance_contrast(const Figures& a, const Figures& b)
{
    if (a.is_shared == b.is_shared) return log_contrast(a.variances, b.variances);
    return product(log_contrast(a.variances, {}), turned_over(log_contrast(b.variances, {})));
}

/// The same of the relative variances, each to the power of its share in the time to 1 %.
LogEstimate relative_contrast(const Figures& a, const Figures& b)
{
    if (a.is_shared && b.is_shared)
        return log_contrast(a.relative_by_region, a.sampling_share, b.relative_by_region,
                            b.sampling_share);
    if (!a.is_shared && !b.is_shared) {
        const std::size_t n = std::min(a.relative_variances.size(), b.relative_variances.size());
        return log_contrast(std::span(a.relative_variances).first(n), a.sampling_share,
                            std::span(b.relative_variances).first(n), b.sampling_share);
    }
    const auto alone = [](const Figures& f) {
        LogEstimate relative = f.relative_log;
        relative.value *= f.sampling_share, relative.se *= f.sampling_share;
        return relative;
    };
    return product(alone(a), turned_over(alone(b)));
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

/// What shared directions say of a probe, of whose own samples the mean stands.
void add_shared_variance(PointFigures& point, const ValueAndError& variance, const Moments& own)
{
    constexpr double normal = 1.96;
    const double value = std::max(variance.value, 0.0), half = normal * variance.se;
    point.variance = {value, std::max(variance.value - half, 0.0), value + half};
    if (own.count > 0) point.mean_se = std::sqrt(value / static_cast<double>(own.count));
}

/// An estimate may only bound what it is of. log_figure: of it.
Interval interval_or_bound(double value, const LogEstimate& log_figure, double se)
{
    if (is_above_errors(log_figure)) return interval_about(value, log_figure);
    constexpr double normal = 1.96;
    return {std::max(value, 0.0), 0, std::max(value, 0.0) + normal * se};
}

/// Standard error of the totals over the regions.
double se_of_totals(const RegionSums& sums)
{
    std::vector<double> totals;
    for (const std::vector<double>& of_replicate : sums)
        totals.push_back(std::accumulate(of_replicate.begin(), of_replicate.end(), 0.0));
    return mean_and_error(totals).se;
}

void add_shared_variances(StrategyReport& report, const SharedFigures& shared,
                          const Figures& figures)
{
    const LogEstimate variance = log_contrast(figures.variances, {});
    report.variance =
        interval_or_bound(figures.variance, variance, se_of_totals(figures.variances));
    report.relative_variance = interval_or_bound(figures.relative_variance, figures.relative_log,
                                                 shared.relative_variance_se);
    if (is_above_errors(figures.relative_log))
        report.relative_variance = widened(report.relative_variance, figures.relative_doubt);
    report.effective_samples = variance.se > 0 ? 1 / (variance.se * variance.se) : 0;
}

void add_variances(StrategyReport& report, const StrategyMeasurements& s, const Figures& figures)
{
    if (figures.is_shared) return add_shared_variances(report, *s.shared, figures);
    report.variance = interval_about(figures.variance, log_contrast(figures.variances, {}));
    report.relative_variance = widened(
        interval_about(figures.relative_variance, figures.relative_log), figures.relative_doubt);
    report.rare_share = s.pooled.rare_share;
    report.effective_samples = s.pooled.participation.number();
}

void add_times(StrategyReport& report, const StrategyMeasurements& s, const Figures& figures)
{
    report.timed_rounds = static_cast<int>(s.times.size());
    const TimeIntervals times = intervals_of(s.times);
    report.seconds_per_sample = times.per_sample;
    report.seconds_per_point = times.per_point;
    const double samples = static_cast<double>(std::max<std::uint64_t>(s.pooled.samples, 1));
    for (const auto& [stage, seconds] : s.stage_seconds)
        report.stage_seconds[stage] = seconds / samples;
    report.rays_per_sample = static_cast<double>(s.rays) / samples;
    const LogEstimate seconds = log_median(figures.seconds_at);
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
        per_point.push_back(time.seconds_per_point);
        per_sample.push_back(time.seconds_per_sample);
    }
    return {interval_of_median(per_point), interval_of_median(per_sample)};
}

namespace {

void add_doubt(Figures& f, const StrategyMeasurements& s)
{
    const double doubt =
        f.is_shared ? s.shared->relative_variance_doubt : s.pooled.relative_variance_doubt;
    f.relative_doubt = std::log1p(std::fabs(doubt) / f.relative_variance);
    f.signed_doubt = std::copysign(f.relative_doubt, doubt);
}

void add_replicates(Figures& f, const StrategyMeasurements& s)
{
    if (f.is_shared) {
        f.variances = s.shared->region_variances;
        f.relative_by_region = s.shared->relative_region_variances;
        f.relative_log = relative_log(*s.shared);
        return;
    }
    for (const ReplicateValues& replicate : s.replicates) {
        f.variances.push_back({replicate.variance});
        f.relative_variances.push_back(replicate.relative_variance);
    }
    f.relative_log = log_mean(f.relative_variances);
    if (s.region_variances.size() == s.replicates.size()) f.variances = s.region_variances;
}

}  // namespace

LogEstimate relative_log(const SharedFigures& shared)
{
    constexpr double from_all_points = 1e6;
    if (!(shared.relative_variance > 0)) return {nan, nan, 1};
    return {std::log(shared.relative_variance),
            shared.relative_variance_se / shared.relative_variance, from_all_points};
}

Figures figures_of(const StrategyMeasurements& s, double at)
{
    Figures f;
    f.exact = s.all_samples_equal_reference;
    f.is_shared = s.shared.has_value();
    f.variance = f.exact ? 0 : f.is_shared ? s.shared->variance : s.pooled.variance;
    f.relative_variance = f.exact       ? 0
                          : f.is_shared ? s.shared->relative_variance
                                        : s.pooled.relative_variance;
    if (f.relative_variance > 0) add_doubt(f, s);
    const double least_samples =
        s.samples_per_observation;  // a part of a scrambling was not measured
    f.samples_to_1_percent = std::max(least_samples, f.relative_variance / one_percent_squared);
    add_replicates(f, s);
    for (const TimeObservation& time : s.times) {
        f.rounds.push_back(time.round);
        f.seconds_at.push_back(time.seconds_per_sample + time.seconds_per_point / at);
        f.seconds_to_1_percent.push_back(time.seconds_for(f.samples_to_1_percent));
    }
    if (f.samples_to_1_percent > least_samples && !s.times.empty()) {
        double sampling = 0, all = 0;
        for (std::size_t i = 0; i < s.times.size(); ++i) {
            sampling += f.samples_to_1_percent * s.times[i].seconds_per_sample;
            all += f.seconds_to_1_percent[i];
        }
        f.sampling_share = all > 0 ? sampling / all : 1;
    }
    return f;
}

namespace {

/// Those that took part in at least two rounds with others, with no observation of 0.
std::vector<Figures*> well_timed(std::span<Figures> figures)
{
    std::vector<Figures*> timed;
    for (Figures& f : figures)
        if (f.rounds.size() >= 2 && f.rounds[1] < of_no_round &&
            std::all_of(f.seconds_at.begin(), f.seconds_at.end(), [](double s) { return s > 0; }))
            timed.push_back(&f);
    return timed;
}

/// All rounds that any took part in.
std::vector<std::uint32_t> rounds_of(std::span<Figures* const> figures)
{
    std::set<std::uint32_t> rounds;
    for (const Figures* f : figures) rounds.insert(f->rounds.begin(), f->rounds.end());
    return {rounds.begin(), rounds.end()};
}

}  // namespace

void remove_drift(std::span<Figures> figures)
{
    const std::vector<Figures*> timed = well_timed(figures);
    if (timed.size() < 2) return;
    const std::vector<std::uint32_t> rounds = rounds_of(timed);
    const auto column_of = [&](std::uint32_t round) {
        return static_cast<std::size_t>(std::ranges::lower_bound(rounds, round) - rounds.begin());
    };
    std::vector<std::vector<double>> logs(timed.size(), std::vector<double>(rounds.size(), nan));
    for (std::size_t s = 0; s < timed.size(); ++s)
        for (std::size_t i = 0; i < timed[s]->rounds.size(); ++i)
            logs[s][column_of(timed[s]->rounds[i])] = std::log(timed[s]->seconds_at[i]);
    const TwoWayFit fit = fit_two_way(logs);
    if (fit.dof < 1) return;
    for (Figures* f : timed) {
        f->time_noise = fit.noise;
        f->time_noise_dof = fit.dof;
        for (std::size_t i = 0; i < f->rounds.size(); ++i) {
            const double slower = std::exp(fit.columns[column_of(f->rounds[i])]);
            f->seconds_at[i] /= slower;
            f->seconds_to_1_percent[i] /= slower;
        }
    }
}

LogEstimate log_variance_ratio(const Figures& a, const Figures& b)
{
    if (a.exact || b.exact) return {a.exact && b.exact ? 0 : a.exact ? -infinity : infinity, 0, 1};
    LogEstimate ratio = variance_contrast(a, b);
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
    LogEstimate samples = relative_contrast(a, b);
    samples.value = 0;  // is in the seconds already
    // What the estimated means may do to either: a bound, taken for two standard errors.
    const double of_a = a.signed_doubt * a.sampling_share, of_b = b.signed_doubt * b.sampling_share;
    const double doubt =
        a.is_shared && b.is_shared ? std::fabs(of_a - of_b) : std::hypot(of_a, of_b);
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
    report.mean_se = figures.exact           ? 0
                     : s.mean_checks.empty() ? mean_and_error(means).se
                                             : s.mean_checks.front().own_se;
    report.variance_from = figures.is_shared ? VarianceSource::shared : VarianceSource::own;
    if (!figures.exact) add_variances(report, s, figures);
    add_times(report, s, figures);
    LogEstimate samples = figures.relative_log;
    samples.se *= figures.sampling_share;
    const LogEstimate cpu_seconds = log_median(figures.seconds_to_1_percent),
                      to_1_percent = product(samples, cpu_seconds);
    report.seconds_to_1_percent =
        widened(interval_about(std::exp(cpu_seconds.value) * static_cast<double>(points) / threads,
                               to_1_percent),
                figures.relative_doubt * figures.sampling_share);
    for (const Moments& probe : s.probes)
        report.probes.push_back(point_figures(probe, s.samples_per_observation, figures.exact));
    if (s.shared && !figures.exact)
        for (std::size_t p = 0; p < report.probes.size(); ++p)
            add_shared_variance(report.probes[p], s.shared->probes[p], s.probes[p]);
    return report;
}

}  // namespace mis
