#pragma once

#include "mis/math/stop_token.h"
#include "mis/run/executor.h"
#include "mis/run/pool.h"
#include "mis/stats/measurements.h"
#include "mis/study/shared_integrals.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mis {

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
    /// With the first one.
    int all_rounds() const { return rounds_; }

    /// The variance of one sample of a strategy at a point, from all rounds there: unbiased, so
    /// that it may be below 0 where little is known. Its error is from the spread of the rounds.
    /// Precondition: two rounds count there.
    ValueAndError at(std::size_t strategy, std::size_t point) const;
    /// Mean over the points, each times its weight; no weights: 1.
    ValueAndError mean(std::size_t strategy, std::span<const double> weights = {}) const;
    /// Direct radiance's luminance at a point: that of every strategy that misses nothing.
    ValueAndError luminance(std::size_t point) const;
    /// Covariance of these two estimates at a point: both are from the same directions.
    double covariance(std::size_t strategy, std::size_t point) const;
    /// The same two from the last take() alone: sums over its rounds that count.
    double last_variance(std::size_t strategy, std::size_t point) const
    {
        return sums_[place(strategy, point)].last;
    }
    double last_luminance(std::size_t point) const { return point_sums_[point].last; }
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
        double last = 0;  ///< of it: the last take()'s
        int rounds = 0;
        int counted() const { return rounds - 1; }
    };
    std::size_t place(std::size_t strategy, std::size_t point) const
    {
        return point * plan_.entries.size() + strategy;
    }
    void begin_take(std::size_t point);
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
