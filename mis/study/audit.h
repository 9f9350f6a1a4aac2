#pragma once

#include "mis/engine/lit_scene.h"
#include "mis/stats/measurements.h"
#include "mis/strategy/strategy.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mis {

/// A shading point that is audited, with its material.
struct AuditPoint {
    ShadingPoint point;
    int material;
    double weight = 0;  ///< 1/(μ² + ε²): what its variance counts in the relative variance
};

/// What directions drawn by *all* techniques at hand say about one strategy's variance at some
/// points: a strategy's own samples cannot see what they never drew.
struct AuditEstimate {
    bool available = false;  ///< not for a policy that draws every light: it misses none
    double variance = 0, variance_se = 0;  ///< of one sample, mean over the points
    double relative_variance = 0, relative_variance_se = 0;  ///< the same, times the weights
};

/// Draws directions from the cones of every policy and from the BSDFs, together a mixture that
/// covers what any of the strategies can meet, and estimates ∫w²F²/p − (∫wF)² of each strategy from
/// the same directions (docs/theory.md §12). In double, one point at a time, through formulas
/// that the pipelines do not run.
std::vector<AuditEstimate> audit(const LitScene& scene, std::span<const AuditPoint> points,
                                 std::span<const Strategy> strategies, std::uint64_t seed,
                                 const AnyExecutor& executor);

}  // namespace mis
