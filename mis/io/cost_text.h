#pragma once

#include "mis/report/cost_report.h"

#include <string>

namespace mis {

/// A scene's curves as a terminal shows them, at most 80 columns wide: slopes, errors after 1, 2,
/// 4, … samples, times to errors, crossings. threads: that the times are for.
std::string cost_text(const CostSceneReport& scene, int threads);

}  // namespace mis
