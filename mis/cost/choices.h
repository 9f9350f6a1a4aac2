#pragma once

#include "mis/report/cost_report.h"

#include <span>
#include <vector>

namespace mis {

/// A strategy in one number type.
struct CostChoice {
    Strategy strategy;
    Precision precision = Precision::in_float;
    bool operator==(const CostChoice&) const = default;
};

/// What belongs beside strategies in one table: the first in double, and the first that mixes light
/// and BSDF draws with four light draws per BSDF draw. by_time: strategies, the soonest to 1 %
/// first.
std::vector<CostChoice> twins_of(std::span<const Strategy> by_time);

}  // namespace mis
