#pragma once

#include "mis/cost/curve.h"

#include <cstdint>
#include <optional>

namespace mis {

/// How far the curves of a cost study are to go.
struct CostGoal {
    std::optional<std::uint64_t> spp;  ///< samples per point of the last doubling; else by the time
    bool is_sobol = false;
};

/// Is a curve done after a doubling of `samples` per point, which took `level_seconds`?
/// seconds_left: its share of the time that is left. Pure: of what was measured, and of the time.
bool is_curve_done(const CostMeasurements& curve, std::uint64_t samples, double level_seconds,
                   double seconds_left, const CostGoal& goal, const ReferenceError& reference);

}  // namespace mis
