#pragma once

#include "mis/report/cost_report.h"

#include <string>
#include <vector>

namespace mis {

/// "power/power", "power/power in double".
std::string name_of(const CostCurveReport& curve);

/// What a scene's curves say, in words. First the answer: which strategy reaches 1 % first, and how
/// its error falls in time beside −½. Then crossings, what does not follow −½, what could not be
/// run.
struct CostWords {
    std::vector<std::string> answer, details;
};
CostWords words_of(const CostSceneReport& scene);

/// Both.
std::vector<std::string> sentences_of(const CostSceneReport& scene);

/// The details, as one sentence for each kind: how many there are of it, and the first of them.
std::vector<std::string> kinds_of_doubt(const CostSceneReport& scene);

}  // namespace mis
