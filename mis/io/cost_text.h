#pragma once

#include "mis/io/text_layout.h"
#include "mis/report/cost_report.h"

#include <string>

namespace mis {

/// A scene's curves as a terminal shows them: slopes, errors after 1, 2, 4, … samples, times to
/// errors, a legend of the marks, crossings and doubts, and the answer last. threads: that the
/// times are for.
std::string cost_text(const CostSceneReport& scene, int threads, const TextLook& look = {});

}  // namespace mis
