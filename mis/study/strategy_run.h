#pragma once

#include "mis/engine/lit_scene.h"
#include "mis/stats/measurements.h"
#include "mis/stats/pool.h"
#include "mis/study/study_points.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mis {

/// Observations per replicate and point that a round takes, tile by tile: samples, or scramblings
/// of samples_per_scrambling.
using Allocation = std::vector<int>;

/// One strategy under way: all that its samples came to so far. Results do not depend on who ran
/// which tile.
class StrategyRun {
public:
    /// Throws Stopped.
    StrategyRun(const LitScene& scene, const StudyPoints& points, const Strategy& strategy,
                const NumberSource& numbers, const StopToken& stop = {});

    /// What every point gets in a round: allocation[tile] observations for each of the replicates
    /// [first, end) of `replicates`.
    struct Round {
        const Allocation& allocation;
        int first, end, replicates;
        /// Of the round, as its observation of time has it; none where it is not timed.
        std::optional<std::uint32_t> number = {};
    };

    /// The next samples of every point. weights: 1/(μ² + ε²) of every point. Every observation of
    /// time is of the same mix of points, however unevenly tiles are sampled. False where it was
    /// stopped: then the round does not count, though some points keep its samples.
    bool sample_round(const Round& round, std::span<const double> weights,
                      WorkspacePool<float>& workspaces, const AnyExecutor& executor,
                      const StopToken& stop = {});

    /// What every point gets outside the replicates: it counts in the points' moments alone.
    struct Apart {
        int observations;
        /// Of the observation of time, which is not made where there is none.
        std::optional<std::uint32_t> round = {};
        /// Above 1: so many parts of the tiles, one after the other, each an observation of time by
        /// itself, of no round.
        int parts = 1;
    };

    /// False where it was stopped.
    bool sample_apart(const Apart& apart, WorkspacePool<float>& workspaces,
                      const AnyExecutor& executor, const StopToken& stop = {});

    /// Observations of time.
    std::size_t timed() const { return times_.size(); }

    /// CPU seconds per sample and per point's preparation, from `samples` at a few points; leaves
    /// no trace. Throws Stopped.
    TimeObservation try_out(int samples, std::size_t points, WorkspacePool<float>& workspaces,
                            const StopToken& stop = {}) const;

    const Strategy& strategy() const { return ready_.strategy(); }
    std::uint64_t samples() const { return samples_; }  ///< over all shading points
    std::span<const PointResult> results() const { return results_; }
    /// Of one sample at a shading point (docs/theory.md (70)); NaN for fewer than two observations.
    double variance_at(std::size_t point) const
    {
        return samples_per_observation_ * results_[point].luminance.variance();
    }

    /// The first sample, tile by tile, that is no number; nothing where all are.
    std::optional<SampleName> first_invalid() const;

    /// Samples of this tile that were no numbers.
    std::uint64_t invalid_at(std::size_t tile) const { return tiles_[tile].cost.invalid; }

    /// scale: μ² + ε² of every point.
    StrategyMeasurements measurements(const RelativeScale& scale) const;

private:
    /// What a replicate's samples came to: sums over a tile's points, times the weights beside.
    struct ReplicateSums {
        ChunkTotals totals;
        double observations = 0, degrees = 0;  ///< Σ observations, Σ (observations − 1)
    };
    struct TileSums {
        std::vector<ReplicateSums> replicates;
        TileTotals cost;
        std::uint64_t samples_per_point = 0;
    };
    /// What the tiles cost; empty where it was stopped.
    std::vector<TileTotals> run_tiles(const Allocation& allocation, int chunks,
                                      std::span<const double> weights,
                                      std::vector<std::vector<ChunkTotals>>& totals,
                                      WorkspacePool<float>& workspaces, const AnyExecutor& executor,
                                      const StopToken& stop);
    void forget();  ///< all samples
    TimeObservation observed(std::span<const TileTotals> totals, std::uint32_t round) const;
    void add_replicates(StrategyMeasurements& m) const;
    void add_costs(StrategyMeasurements& m) const;

    const StudyPoints* points_;
    int samples_per_observation_;
    ReadyStrategy<float> ready_;
    std::vector<PointResult> results_;
    std::vector<TileSums> tiles_;
    std::vector<TimeObservation> times_;
    std::uint64_t samples_ = 0;
};

}  // namespace mis
