#include "mis/study/affordable.h"

#include "mis/strategy/names.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mis {

namespace {

/// CPU seconds that it takes at the very least: no machine does less per light.
double least_seconds(const StudyGround& ground, const Strategy& strategy, int samples)
{
    const double lights = static_cast<double>(ground.scene.scene().lights.size()),
                 points = static_cast<double>(ground.points.figure_lit);
    if (!strategy.chooses_light()) return 0;
    if (draws_every_light(strategy.policy)) return points * lights * samples * 10e-9;
    return reads_all_lights(strategy.policy) ? points * lights * 0.5e-9 : 0;
}

double tried_out(const StudyGround& ground, const Strategy& strategy, int samples)
{
    const StrategyRun run(ground.scene, ground.points, strategy, ground.seed);
    // The first touch of memory is no cost of the strategy.
    TimeObservation cost = run.try_out(1, 4, ground.workspaces);
    if (cost.seconds_per_sample < 1e-3) cost = run.try_out(8, 32, ground.workspaces);
    return static_cast<double>(ground.points.figure_lit) *
           (samples * cost.seconds_per_sample + cost.seconds_per_point);
}

}  // namespace

std::vector<CostEstimate> estimate_costs(const StudyGround& ground,
                                         std::span<const Strategy> strategies, int samples,
                                         double cpu_seconds)
{
    std::vector<CostEstimate> costs(strategies.size());
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        const double least = least_seconds(ground, strategies[s], samples);
        costs[s].seconds = least <= cpu_seconds
                               ? std::max(least, tried_out(ground, strategies[s], samples))
                               : least;
        costs[s].is_affordable = least <= cpu_seconds;
    }
    std::vector<std::size_t> order(strategies.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return costs[a].seconds < costs[b].seconds;
    });
    double sum = 0;
    for (const std::size_t s : order) {
        if (!costs[s].is_affordable) continue;
        if (sum > 0 && sum + costs[s].seconds > cpu_seconds) costs[s].is_affordable = false;
        sum += costs[s].seconds;
    }
    return costs;
}

}  // namespace mis
