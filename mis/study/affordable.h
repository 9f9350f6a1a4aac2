#pragma once

#include "mis/study/pilot.h"

namespace mis {

/// What a first look at a strategy's cost found.
struct CostEstimate {
    double seconds = 0;         ///< CPU seconds of `samples` samples at every point
    bool is_affordable = true;  ///< within the budget, together with all that are cheaper
};

/// Estimates what `samples` samples of every point cost, strategy by strategy: by a floor that the
/// number of lights puts under it and, where that is affordable, by trying out a few points. The
/// cheapest strategy is always affordable if its floor is. cpu_seconds: the budget for all
/// together.
std::vector<CostEstimate> estimate_costs(const StudyGround& ground,
                                         std::span<const Strategy> strategies, int samples,
                                         double cpu_seconds);

}  // namespace mis
