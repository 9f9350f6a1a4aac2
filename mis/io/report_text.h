#pragma once

#include "mis/io/text_layout.h"
#include "mis/report/report.h"

#include <string>

namespace mis {

// The report as a terminal shows it, UTF-8 for ±; design §3, console output of `compare`. What was
// found comes first and the answer last, where a person looks when it is done.

/// One scene: what it is, the table by rank with a legend of its marks, one sentence for each kind
/// of trouble (all there is to say where the look is verbose), and the verdict.
std::string scene_text(const SceneReport& scene, const Report& report, const TextLook& look = {});

/// The table alone. `~` before a name: not decided against every other, so that the rank is an
/// interval; `=`: tied. What is not ranked follows, with its state.
std::string ranking_text(const SceneReport& scene, const TextLook& look = {});

/// The ranking over all scenes; empty unless there are several.
std::string overall_text(const Report& report, const TextLook& look = {});

/// Every scene, and the overall ranking.
std::string report_text(const Report& report, const TextLook& look = {});

}  // namespace mis
