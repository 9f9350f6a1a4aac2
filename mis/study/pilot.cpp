#include "mis/study/pilot.h"

#include "mis/stats/exactness.h"
#include "mis/stats/pool.h"

#include <algorithm>
#include <cmath>

namespace mis {

namespace {

/// A rough look takes so many samples of a point; where few strategies are looked at, four times.
constexpr int pilot_samples = 8;
constexpr std::size_t few_strategies = 6;

StrategyRun sampled(const StudyGround& ground, const Strategy& strategy, int samples)
{
    StrategyRun run(ground.scene, ground.points, strategy, ~ground.seed, ground.stop);
    if (!run.sample_apart({samples}, ground.workspaces, ground.executor, ground.stop))
        throw Stopped();
    return run;
}

/// What a tile adds to the squared relative error of a strategy's variance, per sample: Σ μ4 / V².
void add_benefit(std::vector<double>& benefit, const StrategyRun& run, const StudyPoints& points)
{
    std::vector<double> fourth(benefit.size());
    double variance = 0, squares = 0;
    for (std::size_t t = 0; t < benefit.size(); ++t) {
        const Tile& tile = points.shading.tiles[t];
        for (const PointResult& result : run.results().subspan(tile.first, tile.count)) {
            variance += result.luminance.variance();
            squares += result.luminance.mean * result.luminance.mean;
            fourth[t] += result.luminance.m4;
        }
    }
    const double of_rounding = rounding_of_samples * rounding_of_samples * squares;
    if (!(variance > of_rounding)) return;  // exact, as it seems: it needs no more samples anywhere
    for (std::size_t t = 0; t < benefit.size(); ++t)
        benefit[t] += fourth[t] / (variance * variance);
}

}  // namespace

std::vector<double> rough_weights(const StudyGround& ground)
{
    const Scene& scene = ground.scene.scene();
    const double pairs =
        static_cast<double>(scene.lights.size()) * static_cast<double>(ground.points.figure_lit);
    const StrategyRun run =
        sampled(ground, parse_strategy(pairs < 1e8 ? "radiant-solid-angle/power" : "power/power"),
                pilot_samples);
    std::vector<double> weights;
    for (const PointResult& result : run.results()) weights.push_back(result.luminance.mean);
    weights = relative_scale(std::move(weights), ground.points.figures()).squares;
    for (double& w : weights) w = w > 0 ? 1 / w : 0;
    return weights;
}

std::vector<double> best_tile_factors(const StudyGround& ground,
                                      std::span<const Strategy> strategies)
{
    const StudyPoints& points = ground.points;
    std::vector<double> benefit(points.figure_tiles);
    const int samples = strategies.size() <= few_strategies ? 4 * pilot_samples : pilot_samples;
    for (const Strategy& strategy : strategies)
        add_benefit(benefit, sampled(ground, strategy, samples), points);
    double mean = 0;
    std::vector<double> wanted(benefit.size());
    for (std::size_t t = 0; t < benefit.size(); ++t) {
        const double count = points.shading.tiles[t].count;
        wanted[t] = std::sqrt(benefit[t] / count);
        mean += wanted[t] * count / static_cast<double>(points.figure_lit);
    }
    std::vector<double> factors(points.shading.tiles.size(), 1.0);
    if (!(mean > 0)) return factors;
    for (std::size_t t = 0; t < benefit.size(); ++t)
        factors[t] = std::clamp(wanted[t] / mean, 0.5, 32.0);
    return factors;
}

}  // namespace mis
