#pragma once

#include "mis/compare/measurements.h"
#include "mis/compare/study_points.h"
#include "mis/engine/lit_scene.h"

#include <span>
#include <vector>

namespace mis {

/// One strategy under way: all that its samples came to so far. Results do not depend on who ran which tile.
class StrategyRun {
public:
    StrategyRun(const LitScene& scene, const StudyPoints& points, const Strategy& strategy, std::uint64_t seed);

    /// The next samples of every point. weights: 1/(μ² + ε²) of every point. is_round: the chunks are those of the
    /// replicates, in order, and their time is an observation; else they count in the points' moments alone.
    void sample(int chunk, int chunks, bool is_round, std::span<const double> weights, WorkspacePool<float>& workspaces,
                const AnyExecutor& executor);

    /// CPU seconds per sample and per point's preparation, from `samples` at a few points; leaves no trace.
    TimeObservation try_out(int samples, std::size_t points, WorkspacePool<float>& workspaces) const;

    const Strategy& strategy() const { return ready_.strategy(); }
    std::uint64_t samples_per_point() const { return samples_; }
    double wall_seconds() const { return wall_seconds_; }
    const TileTotals& totals() const { return totals_; }
    std::span<const PointResult> results() const { return results_; }

    /// scale: μ² + ε² of every point.
    StrategyMeasurements measurements(std::span<const double> scale) const;

private:
    void take_round(int chunk, int chunks, const std::vector<std::vector<ChunkTotals>>& chunk_totals,
                    const TileTotals& round);

    const StudyPoints* points_;
    ReadyStrategy<float> ready_;
    std::vector<PointResult> results_;
    std::uint64_t samples_ = 0;
    double wall_seconds_ = 0;
    TileTotals totals_;
    std::vector<ReplicateValues> replicate_sums_;             ///< times their weights below
    std::vector<std::vector<double>> region_sums_;            ///< [replicate][region]
    double mean_weight_ = 0, variance_weight_ = 0;            ///< Σ samples, Σ (samples − 1) of a replicate's chunks
    std::vector<TimeObservation> times_;
};

}  // namespace mis
