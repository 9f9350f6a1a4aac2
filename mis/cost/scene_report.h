#pragma once

#include "mis/cost/curve_run.h"
#include "mis/report/cost_report.h"

#include <span>

namespace mis {

/// What follows from the curves of a scene: their reports, and where they cross. All but the
/// scene's facts, its time, and whether it was stopped.
CostSceneReport report_of(std::span<const CurveRun> curves, const CostGround& ground,
                          bool is_sobol);

}  // namespace mis
