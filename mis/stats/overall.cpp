#include "mis/stats/overall.h"

#include "mis/math/stable.h"
#include "mis/stats/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mis {
namespace {

/// Sum of logarithms over scenes, with the variance of the sum.
struct LogSum {
    double sum = 0, variance = 0;
    int scenes = 0;

    /// ratio: with its 95 % interval from so many replicates (Student's t).
    void add(const Interval& ratio, int replicates)
    {
        sum += std::log(ratio.value);
        const double se = std::log(ratio.high / ratio.low) /
                          (2 * t_quantile(interval_tail, std::max(1, replicates - 1)));
        variance += se * se;
        ++scenes;
    }

    Interval geometric_mean() const
    {
        if (scenes == 0) return unknown_interval();
        return interval_of({sum / scenes, std::sqrt(variance) / scenes, 1e6});
    }
};

int index_of(const SceneReport& scene, const std::string& name)
{
    for (std::size_t i = 0; i < scene.strategies.size(); ++i)
        if (name_of(scene.strategies[i].strategy) == name) return static_cast<int>(i);
    return -1;
}

bool is_ranked_in(const SceneReport& scene, const std::string& name)
{
    const int i = index_of(scene, name);
    return i >= 0 && scene.strategies[i].status == Status::ranked;
}

Interval turned_over(const Interval& x)
{
    return {inverse(x.value), inverse(x.high), inverse(x.low)};
}

/// The figures of strategy i over those of strategy j: variance, variance × time, time to 1 %.
struct Ratios {
    Interval variance{1, 1, 1}, cost{1, 1, 1}, time{1, 1, 1};
};

Ratios ratios_of(const SceneReport& scene, int i, int j)
{
    for (const PairReport& p : scene.pairs) {
        if (p.a == i && p.b == j) return {p.ratio, turned_over(p.efficiency_ratio), p.time_ratio};
        if (p.a == j && p.b == i)
            return {turned_over(p.ratio), p.efficiency_ratio, turned_over(p.time_ratio)};
    }
    return {};
}

/// The ranked strategy with the least `figure`, exact ones only if `exact_too`; nothing where none
/// has one.
template <class Figure>
std::optional<int> least(const SceneReport& scene, bool exact_too, Figure figure)
{
    std::optional<int> best;
    for (std::size_t i = 0; i < scene.strategies.size(); ++i) {
        const StrategyReport& s = scene.strategies[i];
        if (s.status != Status::ranked || (s.exact && !exact_too) || std::isnan(figure(s)))
            continue;
        if (!best || figure(s) < figure(scene.strategies[*best])) best = static_cast<int>(i);
    }
    return best;
}

double place_by_variance(const StrategyReport& s) { return s.rank; }
double place_by_efficiency(const StrategyReport& s)
{
    return s.rank_by_efficiency > 0 ? s.rank_by_efficiency
                                    : std::numeric_limits<double>::quiet_NaN();
}
double seconds(const StrategyReport& s) { return s.seconds_to_1_percent.value; }

OverallReport overall_of(const std::string& name, const std::vector<SceneReport>& scenes)
{
    OverallReport overall;
    overall.name = name;
    LogSum variance, cost, time;
    for (const SceneReport& scene : scenes) {
        const int i = index_of(scene, name);
        const bool exact = scene.strategies[i].exact;
        if (!exact && scene.strategies[*least(scene, true, place_by_variance)].exact)
            ++overall.beaten_by_exact;
        variance.add(exact ? Interval{1, 1, 1}
                           : ratios_of(scene, i, *least(scene, false, place_by_variance)).variance,
                     scene.replicates);
        if (const auto best = least(scene, exact, place_by_efficiency))
            cost.add(ratios_of(scene, i, *best).cost, scene.replicates);
        if (const auto best = least(scene, true, seconds))
            time.add(ratios_of(scene, i, *best).time, scene.replicates);
    }
    overall.variance_ratio = variance.geometric_mean();
    overall.cost_ratio = cost.geometric_mean();
    overall.time_ratio = time.geometric_mean();
    return overall;
}

/// Places by the scenes lost to exact strategies, then by `ratio`; a strategy that has none comes
/// last.
void set_places(std::vector<OverallReport>& all, Interval OverallReport::*ratio,
                int OverallReport::*place)
{
    const auto key = [&](const OverallReport& o) {
        const double value = (o.*ratio).value;
        return std::pair(o.beaten_by_exact,
                         std::isnan(value) ? std::numeric_limits<double>::infinity() : value);
    };
    for (OverallReport& o : all)
        o.*place = 1 + static_cast<int>(std::count_if(
                           all.begin(), all.end(),
                           [&](const OverallReport& other) { return key(other) < key(o); }));
}

}  // namespace

std::vector<OverallReport> rank_overall(const std::vector<SceneReport>& scenes)
{
    std::vector<OverallReport> all;
    if (scenes.size() < 2) return all;
    for (const StrategyReport& strategy : scenes[0].strategies) {
        const std::string name = name_of(strategy.strategy);
        const bool everywhere =
            std::all_of(scenes.begin(), scenes.end(),
                        [&](const SceneReport& s) { return is_ranked_in(s, name); });
        if (everywhere) all.push_back(overall_of(name, scenes));
    }
    set_places(all, &OverallReport::variance_ratio, &OverallReport::rank);
    set_places(all, &OverallReport::cost_ratio, &OverallReport::rank_by_efficiency);
    std::stable_sort(all.begin(), all.end(), [](const OverallReport& a, const OverallReport& b) {
        return a.rank < b.rank;
    });
    return all;
}

}  // namespace mis
