#pragma once

#include "mis/report/cost_report.h"

#include <string>
#include <vector>

namespace mis {

/// "power/power", "power/power in double".
std::string name_of(const CostCurveReport& curve);

/// What a scene's curves say, in words: which strategy reaches 1 % first, crossings, what does not
/// follow −½, what could not be run.
std::vector<std::string> sentences_of(const CostSceneReport& scene);

}  // namespace mis
