#pragma once

#include "mis/math/stop_token.h"
#include "mis/run/executor.h"
#include "mis/run/pool.h"
#include "mis/study/shared_integrals.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mis {

/// The variance of one strategy's sample, from directions that all strategies share.
struct SharedVariance {
    double value = 0;  ///< unbiased; where little is known, it may be below 0
    double se = 0;     ///< standard error, from the spread of the rounds
};

/// What shared samples run on, and from what numbers.
struct SharedRun {
    std::uint64_t seed = 1;
    SharedCounts counts = {};  ///< of each of the groups of a round
    StopToken stop = {};       ///< once it is up, rounds and points that are left are skipped
};

/// The variances of all strategies at some points from one set of directions: each is traced once,
/// and every strategy's densities are evaluated there (Grittmann et al. 2022; Veach 1997, §9.2;
/// docs/theory.md §25). In double, through formulas that the pipelines do not run. The same bits
/// for any number of threads.
class SharedSamples {
public:
    /// strategies: checked (strategy/strategy.h). Keeps a reference to the scene.
    SharedSamples(const LitScene& scene, std::vector<SharedPoint> points,
                  std::span<const Strategy> strategies, const SharedRun& run);

    /// Rounds at every point, each with shared_groups groups of directions. The first round ever
    /// only says what later ones are centred by. Throws Stopped where tables were not ready.
    void take(int rounds, const AnyExecutor& executor);

    /// Is every point as far as the others? Not if it was stopped.
    bool is_even() const;
    /// Rounds that count.
    int rounds() const { return rounds_ - 1; }

    /// At one point. Precondition: two rounds count.
    SharedVariance at(std::size_t strategy, std::size_t point) const;
    /// Mean over the points, each times its weight; no weights: 1.
    SharedVariance mean(std::size_t strategy, std::span<const double> weights = {}) const;
    /// Direct radiance's luminance at a point: that of every strategy that misses nothing.
    SharedVariance luminance(std::size_t point) const;
    /// What of it the strategy never draws, mean over the points: it is biased by that.
    double missed(std::size_t strategy) const;

private:
    /// What a thread needs.
    struct Worker {
        DirectionSet directions;
        SharedIntegrals integrals;
    };
    struct PointSums {
        ReplicateSquares luminance;
        int rounds = 0;
    };
    void take_at(std::size_t point, int rounds, Worker& worker, std::span<double> missed);

    const LitScene* scene_;
    std::vector<SharedPoint> points_;
    SharedPlan plan_;
    SharedRun run_;
    int rounds_ = 0;
    std::vector<SharedSums> sums_;       ///< [point][strategy]
    std::vector<PointSums> point_sums_;  ///< [point]
    std::vector<LightSums> lights_;  ///< [point][strategy that draws every light][light], or empty
    std::vector<double> missed_;     ///< [strategy]
    Pool<std::unique_ptr<Worker>> workers_;
};

}  // namespace mis
