#pragma once

#include "mis/stats/measurements.h"
#include "mis/stats/pool.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace mis {

using Random = std::mt19937_64;

/// One sample, drawn at a point whose true mean is 1.
using SampleOf = std::function<double(Random&)>;

/// What a simulated scene is like.
struct Simulation {
    std::size_t points = 64, regions = 4, samples = 16;  ///< samples per point and replicate
    std::size_t replicates = 16;
    std::uint64_t seed = 1;
    double seconds_per_sample = 1e-8, seconds_per_point = 1e-8, clock_noise = 0.02;
};

/// A light-choice strategy of that policy and the heuristic "power".
inline Strategy named(const std::string& policy)
{
    return {.policy = policy, .heuristic = "power", .technique = "cone"};
}

/// Samples uniform in 1 ± √(3·variance).
inline SampleOf uniform_samples(double variance)
{
    return [half = std::sqrt(3 * variance)](Random& bits) {
        return std::uniform_real_distribution<double>(1 - half, 1 + half)(bits);
    };
}

/// 1/p with probability p, else 0: variance 1/p − 1.
inline SampleOf rare_samples(double p)
{
    return [p](Random& bits) { return std::bernoulli_distribution(p)(bits) ? 1 / p : 0.0; };
}

/// Runs a strategy as the scheduler would: every point, every replicate, merged and per replicate.
inline StrategyMeasurements simulate(const std::string& policy, const SampleOf& sample,
                                     const Simulation& sim = {})
{
    StrategyMeasurements s;
    s.strategy = named(policy);
    std::uint64_t stream = sim.seed;
    for (const char c : policy) stream = stream * 1000003 + static_cast<unsigned char>(c);
    Random bits(stream);
    const std::vector<double> scale(sim.points, 1.0);
    std::vector<Moments> merged(sim.points);
    std::exponential_distribution<double> delay(1);
    for (std::size_t r = 0; r < sim.replicates; ++r) {
        std::vector<Moments> points(sim.points);
        std::vector<double> regions(sim.regions, 0.0), region_variances(sim.regions, 0.0);
        for (std::size_t i = 0; i < sim.points; ++i) {
            for (std::size_t k = 0; k < sim.samples; ++k) points[i].add(sample(bits));
            merged[i].merge(points[i]);
            regions[i % sim.regions] +=
                points[i].mean * static_cast<double>(sim.regions) / static_cast<double>(sim.points);
            region_variances[i % sim.regions] +=
                points[i].variance() / static_cast<double>(sim.points);
        }
        const PooledFigures figures = pool_points(points, scale);
        s.replicates.push_back({figures.mean, figures.variance, figures.relative_variance});
        s.region_means.push_back(regions);
        s.region_variances.push_back(region_variances);
        const double late = 1 + sim.clock_noise * delay(bits);
        s.times.push_back({sim.seconds_per_sample * late, sim.seconds_per_point * late,
                           static_cast<std::uint32_t>(r)});
    }
    s.pooled = pool_points(merged, scale);
    for (std::size_t region = 0; region < sim.regions; ++region) {
        std::vector<Moments> own;
        for (std::size_t i = region; i < sim.points; i += sim.regions) own.push_back(merged[i]);
        s.region_participation.push_back(participation_of(own));
    }
    return s;
}

/// One that gives the mean in every sample, and was proved to.
inline StrategyMeasurements simulate_exact(const std::string& policy, const Simulation& sim = {})
{
    StrategyMeasurements s = simulate(
        policy, [](Random&) { return 1.0; }, sim);
    s.all_samples_equal_reference = true;
    return s;
}

/// The largest rate that is seen in `runs` runs, but once in 3 million, if the true rate is `rate`
/// (5 standard errors).
inline double rate_bound(double rate, int runs)
{
    return rate + 5 * std::sqrt(rate * (1 - rate) / runs);
}

}  // namespace mis
