#pragma once

#include "mis/cost/choices.h"
#include "mis/engine/lit_scene.h"

#include <atomic>
#include <functional>
#include <optional>
#include <span>

namespace mis {

struct CostOptions {
    std::uint64_t seed = 1;
    bool is_sobol = false;             ///< a replicate of a point is one scrambled sequence
    double seconds = 30;               ///< wall time, for all
    std::optional<std::uint64_t> spp;  ///< samples per point of the last doubling, for every curve
    /// Adds twins_of() the strategies, by what the first three doublings say.
    bool adds_twins = false;
    const std::atomic<bool>* stop = nullptr;  ///< set from outside: end with the results so far
    std::function<void(double done, const std::string& doing)> progress;
};

/// Measures the error of every choice after 1, 2, 4, … samples per point, against a reference that
/// shares no sample with it, and what follows from that. Choices take turns, replicate by
/// replicate, in random order. One stops doubling once it is past the smallest error asked for,
/// once the reference tells no more, or where the next doubling would not fit its share of the time
/// left. The figures are over the camera's points, or without a camera over the probes.
CostSceneReport run_cost_study(const LitScene& scene, std::span<const CostChoice> choices,
                               const CostOptions& options, const AnyExecutor& executor);

}  // namespace mis
