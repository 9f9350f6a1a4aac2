#include "mis/stats/at_counts.h"

#include <cmath>
#include <initializer_list>

namespace mis {
namespace {

/// A product of independent figures: half widths of their logarithms add up in squares.
Interval about(double value, std::initializer_list<Interval> parts)
{
    double below = 0, above = 0;
    for (const Interval& part : parts) {
        below += std::pow(std::log(part.value / part.low), 2);
        above += std::pow(std::log(part.high / part.value), 2);
    }
    return {value, value * std::exp(-std::sqrt(below)), value * std::exp(std::sqrt(above))};
}

Interval turned(const Interval& x) { return {1 / x.value, 1 / x.high, 1 / x.low}; }

Interval error_of(const Interval& relative_variance, double n)
{
    return {std::sqrt(relative_variance.value / n), std::sqrt(relative_variance.low / n),
            std::sqrt(relative_variance.high / n)};
}

}  // namespace

CountFigures at_count(const StrategyReport& s, double at, double n)
{
    CountFigures c{.n = n, .status = s.status, .reason = s.reason};
    c.estimated_seconds = s.estimated_seconds;
    c.variance = s.variance;
    c.relative_variance = s.relative_variance;
    const Interval &point = s.seconds_per_point, &sample = s.seconds_per_sample;
    c.seconds_per_sample = {sample.value + point.value / n, sample.low + point.low / n,
                            sample.high + point.high / n};
    c.relative_error = error_of(c.relative_variance, n);
    if (n == at || s.exact || s.status == Status::not_run) c.efficiency = s.efficiency;
    else
        c.efficiency = about(1 / (c.variance.value * c.seconds_per_sample.value),
                             {turned(c.variance), turned(c.seconds_per_sample)});
    return c;
}

Interval cost_ratio(const CountFigures& a, const CountFigures& b)
{
    return about(a.relative_variance.value * a.seconds_per_sample.value /
                     (b.relative_variance.value * b.seconds_per_sample.value),
                 {a.relative_variance, a.seconds_per_sample, turned(b.relative_variance),
                  turned(b.seconds_per_sample)});
}

std::optional<BestAtCount> best_at_count(const SceneReport& scene, int leader, std::size_t k)
{
    const auto figures = [&](int i) -> const CountFigures* {
        const StrategyReport& s = scene.strategies[static_cast<std::size_t>(i)];
        const bool is_known = !s.exact && k < s.at_counts.size() &&
                              s.at_counts[k].status == Status::ranked &&
                              s.at_counts[k].seconds_per_sample.value > 0 &&
                              s.at_counts[k].relative_variance.value > 0;
        return is_known ? &s.at_counts[k] : nullptr;
    };
    if (leader < 0 || !figures(leader)) return std::nullopt;
    BestAtCount best{leader, {1, 1, 1}};
    for (int i = 0; i < static_cast<int>(scene.strategies.size()); ++i)
        if (i != leader && figures(i))
            if (const Interval r = cost_ratio(*figures(leader), *figures(i));
                r.value > best.sooner.value)
                best = {i, r};
    const Interval& r = best.sooner;
    const bool is_sure = r.value > 1 && std::log(r.value / r.low) * 2 < std::log(r.value);
    return best.best != leader && is_sure ? std::optional(best) : std::nullopt;
}

}  // namespace mis
