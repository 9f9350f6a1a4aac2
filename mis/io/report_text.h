#pragma once

#include "mis/report/report.h"

#include <string>

namespace mis {

// The report as a terminal shows it: 80 columns, UTF-8 for ±, no colour. design §3, console output
// of `compare`.

/// One scene: what it is, the table by rank, and the sentences. `~` before a name: not told apart
/// from every neighbour (tied, or undecided), so that the rank is an interval. What is not ranked
/// follows, with its state; the sentences say why.
std::string scene_text(const SceneReport& scene, const Report& report);

/// The table alone.
std::string ranking_text(const SceneReport& scene);

/// The ranking over all scenes; empty unless there are several.
std::string overall_text(const Report& report);

/// Every scene, and the overall ranking.
std::string report_text(const Report& report);

}  // namespace mis
