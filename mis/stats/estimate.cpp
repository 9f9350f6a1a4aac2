#include "mis/stats/estimate.h"

#include "mis/math/limits.h"
#include "mis/math/moments.h"
#include "mis/math/stable.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace mis {
namespace {

double as_double(std::size_t n) { return static_cast<double>(n); }

/// Adds weight·log(mean of all replicates but r) to logs[r]. False if such a mean is 0.
bool add_leave_one_out_logs(std::span<const double> replicates, double weight,
                            std::vector<double>& logs)
{
    if (weight == 0) return true;
    const double sum = std::accumulate(replicates.begin(), replicates.end(), 0.0);
    for (std::size_t r = 0; r < replicates.size(); ++r) {
        const double rest = sum - replicates[r];
        if (!(rest > 1e-12 * sum)) return false;  // or only rounding is left
        logs[r] += weight * std::log(rest / as_double(replicates.size() - 1));
    }
    return true;
}

double log_of_mean(std::span<const double> values) { return std::log(mean_and_error(values).mean); }

}  // namespace

LogEstimate product(const LogEstimate& a, const LogEstimate& b)
{
    const double va = a.se * a.se, vb = b.se * b.se, v = va + vb;
    const double dof =
        v > 0 ? v * v / ((va > 0 ? va * va / a.dof : 0) + (vb > 0 ? vb * vb / b.dof : 0))
              : std::max(a.dof, b.dof);
    return {a.value + b.value, std::sqrt(v), dof};
}

LogEstimate turned_over(LogEstimate estimate)
{
    estimate.value = -estimate.value;
    return estimate;
}

LogEstimate log_contrast(std::span<const double> a, double weight_a, std::span<const double> b,
                         double weight_b)
{
    assert(weight_a == 0 || weight_b == 0 || a.size() == b.size());
    const std::size_t n = weight_a != 0 ? a.size() : b.size();
    LogEstimate contrast{0, nan, n > 0 ? as_double(n - 1) : 0};
    if (weight_a != 0) contrast.value += weight_a * log_of_mean(a);
    if (weight_b != 0) contrast.value -= weight_b * log_of_mean(b);
    if (weight_a == 0 && weight_b == 0) return {0, 0, 1};
    std::vector<double> logs(n, 0.0);
    if (n < 2 || !add_leave_one_out_logs(a, weight_a, logs) ||
        !add_leave_one_out_logs(b, -weight_b, logs))
        return contrast;
    contrast.se =
        std::sqrt(as_double(n - 1) / as_double(n) * Moments::of(std::span<const double>(logs)).m2);
    return contrast;
}

namespace {

/// NaN of none.
double mean_of_totals(const RegionSums& figure)
{
    if (figure.empty()) return nan;
    double sum = 0;
    for (const std::vector<double>& replicate : figure)
        sum = std::accumulate(replicate.begin(), replicate.end(), sum);
    return sum / as_double(figure.size());
}

}  // namespace

LogEstimate log_contrast(const RegionSums& a, double weight_a, const RegionSums& b, double weight_b)
{
    const std::size_t n = b.empty() ? a.size() : std::min(a.size(), b.size());
    const double mean_a = mean_of_totals(a), mean_b = b.empty() ? 1 : mean_of_totals(b);
    LogEstimate contrast{weight_a * std::log(mean_a) - weight_b * std::log(mean_b), nan,
                         n > 0 ? as_double(n - 1) : 0};
    if (n < 2 || !(mean_a > 0) || !(mean_b > 0)) return contrast;
    double variance = 0, squares = 0;
    std::vector<double> shares(n);
    for (std::size_t g = 0; g < a[0].size(); ++g) {
        for (std::size_t r = 0; r < n; ++r)
            shares[r] = weight_a * a[r][g] / mean_a - (b.empty() ? 0 : weight_b * b[r][g] / mean_b);
        const double v = std::pow(mean_and_error(shares).se, 2);
        variance += v, squares += v * v;
    }
    contrast.se = std::sqrt(variance);
    if (squares > 0) contrast.dof *= variance * variance / squares;
    return contrast;
}

LogEstimate log_mean(std::span<const double> replicates)
{
    return log_contrast(replicates, 1, {}, 0);
}

LogEstimate median(std::vector<double> values)
{
    const std::size_t n = values.size();
    if (n == 0) return {nan, nan, 0};
    std::sort(values.begin(), values.end());
    const double middle = 0.5 * (values[(n - 1) / 2] + values[n / 2]);
    if (n < 6) return {middle, mean_and_error(values).se, as_double(n - 1)};
    // The interval [k-th smallest, k-th largest] misses the median with probability 2 P(Binomial(n,
    // ½) < k).
    const boost::math::binomial flips(as_double(n), 0.5);
    auto k = static_cast<std::size_t>(
        std::max(1.0, std::floor(boost::math::quantile(flips, interval_tail))));
    while (k > 1 && boost::math::cdf(flips, as_double(k - 1)) > interval_tail) --k;
    while (boost::math::cdf(flips, as_double(k)) <= interval_tail) ++k;
    const double missed = boost::math::cdf(flips, as_double(k - 1));
    const double half_width = 0.5 * (values[n - k] - values[k - 1]);
    return {middle, half_width / boost::math::quantile(complement(boost::math::normal(), missed)),
            as_double(n - 1)};
}

LogEstimate log_median(const std::vector<double>& values)
{
    const LogEstimate linear = median(values);
    if (!(linear.value > 0)) return {nan, nan, linear.dof};
    return {std::log(linear.value), linear.se / linear.value, linear.dof};
}

Interval interval_of_median(std::vector<double> values)
{
    const LogEstimate m = median(std::move(values));
    if (std::isnan(m.se)) return {m.value, m.se, m.se};
    const double half_width = m.se > 0 ? t_quantile(interval_tail, m.dof) * m.se : 0;
    return {m.value, std::max(0.0, m.value - half_width), m.value + half_width};
}

double upper_tail(double t, double dof)
{
    if (std::isinf(t)) return t > 0 ? 0 : 1;
    return boost::math::cdf(complement(boost::math::students_t(dof), t));
}

double t_quantile(double tail, double dof)
{
    return boost::math::quantile(complement(boost::math::students_t(dof), tail));
}

bool is_above_errors(const LogEstimate& log_figure)
{
    return std::isfinite(log_figure.value) && 3 * log_figure.se <= 1;
}

double two_sided_p(const LogEstimate& estimate, double at)
{
    const double distance = std::fabs(estimate.value - at);
    if (std::isnan(distance) || std::isnan(estimate.se)) return 1;
    if (estimate.se == 0) return distance > 0 ? 0 : 1;
    return std::min(1.0, 2 * upper_tail(distance / estimate.se, estimate.dof));
}

double upper_p(const LogEstimate& estimate, double at)
{
    const double excess = estimate.value - at;
    if (std::isnan(excess) || std::isnan(estimate.se)) return 1;
    if (estimate.se == 0) return excess > 0 ? 0 : 1;
    return upper_tail(excess / estimate.se, estimate.dof);
}

Interval interval_of(const LogEstimate& log_figure)
{
    return interval_about(std::exp(log_figure.value), log_figure);
}

Interval interval_about(double centre, const LogEstimate& log_figure)
{
    if (std::isnan(log_figure.se) || std::isnan(centre)) return {centre, nan, nan};
    if (log_figure.se == 0) return {centre, centre, centre};
    const double half_width = t_quantile(interval_tail, log_figure.dof) * log_figure.se;
    if (half_width > 300)
        return {centre, nan, nan};  // e^300: nothing is known, and its square overflows
    return {centre, centre * std::exp(-half_width), centre * std::exp(half_width)};
}

Interval widened(const Interval& interval, double half_width)
{
    const auto factor = [&](double end) {
        return std::exp(std::hypot(std::log(end / interval.value), half_width));
    };
    if (half_width == 0 || !(interval.low > 0)) return interval;
    return {interval.value, interval.value / factor(interval.low),
            interval.value * factor(interval.high)};
}

Interval unknown_interval() { return {nan, nan, nan}; }

MeanAndError mean_and_error(std::span<const double> values)
{
    const Moments moments = Moments::of(values);
    return {values.empty() ? nan : moments.mean, moments.mean_se()};
}

}  // namespace mis
