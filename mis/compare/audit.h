#pragma once

#include "mis/compare/measurements.h"
#include "mis/engine/lit_scene.h"
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

/// How many lights a direction to one of them meets from these points, in the
/// mean over a few.
double lights_along_a_direction(const LitScene& scene, std::span<const AuditPoint> points,
                                std::uint64_t seed, const StopToken& stop = {});

/// How many points an audit looks at, and how many draws of every technique a
/// group has of each.
struct AuditEffort {
    std::size_t points = 0, repeats = 1;
};
/// All that `points` points call for, or less where many lights stand one
/// behind the other: each light that a direction meets is weighed by every
/// policy. None where even one would take long.
AuditEffort audit_effort(std::size_t points, std::span<const Strategy> strategies,
                         double lights_along);

/// Draws directions from the cones of every policy and from the BSDFs, together a mixture that
/// covers what any of the strategies can meet, and estimates ∫w²F²/p − (∫wF)² of each strategy from
/// the same directions (docs/theory.md §12). In double, one point at a time, through formulas
/// that the pipelines do not run. Throws Stopped.
std::vector<AuditEstimate> audit(const LitScene& scene, std::span<const AuditPoint> points,
                                 std::span<const Strategy> strategies, std::size_t repeats,
                                 std::uint64_t seed, const AnyExecutor& executor,
                                 const StopToken& stop = {});

}  // namespace mis
