#include "mis/study/affordable.h"

#include "mis/strategy/names.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mis {

namespace {

/// CPU seconds that it takes at the very least: no machine does less per light. The tables of a
/// policy take some, too, so that what needs none has the first turn.
double least_seconds(const StudyGround& ground, const Strategy& strategy, int samples)
{
    const double lights = static_cast<double>(ground.scene.scene().lights.size()),
                 points = static_cast<double>(ground.points.figure_lit);
    if (!strategy.chooses_light()) return 0;
    const double tables = lights * 0.2e-9;
    if (draws_every_light(strategy.policy)) return tables + points * lights * samples * 10e-9;
    return tables + (reads_all_lights(strategy.policy) ? points * lights * 0.5e-9 : 0);
}

double tried_out(const StudyGround& ground, const Strategy& strategy, double samples)
{
    const StrategyRun run(ground.scene, ground.points, strategy, ground.seed, ground.stop);
    // The first touch of memory is no cost of the strategy.
    TimeObservation cost = run.try_out(1, 4, ground.workspaces, ground.stop);
    if (cost.seconds_per_sample < 1e-3) cost = run.try_out(8, 32, ground.workspaces, ground.stop);
    return static_cast<double>(ground.points.figure_lit) *
           (samples * cost.seconds_per_sample + cost.seconds_per_point);
}

/// least: the floor.
CostEstimate estimate(const StudyGround& ground, const Strategy& strategy, double samples,
                      double least, double cpu_seconds)
{
    if (!(least <= cpu_seconds)) return {least, false, true};
    try {
        return {std::max(least, tried_out(ground, strategy, samples)), true, true};
    } catch (const Stopped&) {
        return {least, false, false};
    }
}

/// The numbers of `values`, the least first.
std::vector<std::size_t> from_least(const std::vector<double>& values)
{
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    return order;
}

}  // namespace

std::vector<CostEstimate> estimate_costs(const StudyGround& ground,
                                         std::span<const Strategy> strategies, int samples,
                                         double cpu_seconds, int samples_per_observation)
{
    const auto samples_of = [&](const Strategy& s) {
        return s.model == Model::strata
                   ? double(samples) / samples_per_observation * samples_together(s)
                   : double(samples);
    };
    std::vector<double> least;
    for (const Strategy& strategy : strategies)
        least.push_back(least_seconds(ground, strategy, samples));
    std::vector<CostEstimate> costs(strategies.size());
    for (const std::size_t s : from_least(least))
        costs[s] =
            estimate(ground, strategies[s], samples_of(strategies[s]), least[s], cpu_seconds);
    keep_affordable(costs, cpu_seconds);
    return costs;
}

void keep_affordable(std::vector<CostEstimate>& costs, double cpu_seconds)
{
    std::vector<double> seconds;
    for (const CostEstimate& cost : costs) seconds.push_back(cost.seconds);
    double sum = 0;
    for (const std::size_t s : from_least(seconds)) {
        if (!costs[s].is_affordable) continue;
        if (sum > 0 && sum + costs[s].seconds > cpu_seconds) costs[s].is_affordable = false;
        sum += costs[s].seconds;
    }
}

}  // namespace mis
