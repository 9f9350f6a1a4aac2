#pragma once

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

/// What directions drawn by all techniques at hand say about one strategy's variance.
struct AuditEstimate {
    bool available = false;  ///< not for a policy that draws every light: it misses none
    double variance = 0, variance_se = 0;  ///< of one sample, mean over the points
    double relative_variance = 0, relative_variance_se = 0;  ///< the same, times the weights
};

/// The twin of SharedSamples, plainer and noisier: directions from the cones of every policy and
/// from the BSDFs, as they come, one at a time, and ∫w²F²/p − (∫wF)² of each strategy from them
/// (docs/theory.md §12), not centred.
std::vector<AuditEstimate> scalar_audit(const LitScene& scene, std::span<const AuditPoint> points,
                                        std::span<const Strategy> strategies, std::uint64_t seed,
                                        const AnyExecutor& executor);

}  // namespace mis
