#pragma once

#include "mis/study/pilot.h"

namespace mis {

/// What a first look at a strategy's cost found.
struct CostEstimate {
    double seconds = 0;         ///< CPU seconds of `samples` samples at every point
    bool is_affordable = true;  ///< within the budget, together with all that are cheaper
    bool is_known = true;       ///< else `seconds` is a floor: there was no time for a first look
    bool is_late = false;       ///< affordable at first, but the set-up took the time
};

/// Estimates what `samples` samples of every point cost (of `strata` as many observations),
/// strategy by strategy: by a floor that the number of lights puts under it and, where that is
/// affordable, by trying out a few points. The cheapest strategy is always affordable if its floor
/// is. cpu_seconds: the budget for all together. Those that could not be tried out before
/// ground.stop was up are not affordable.
std::vector<CostEstimate> estimate_costs(const StudyGround& ground,
                                         std::span<const Strategy> strategies, int samples,
                                         double cpu_seconds, int samples_per_observation = 1);

/// Lets those go that are not affordable together with all that are cheaper, by
/// the same rule. The cheapest one stays.
void keep_affordable(std::vector<CostEstimate>& costs, double cpu_seconds);

}  // namespace mis
