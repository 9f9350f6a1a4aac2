#pragma once

#include "mis/io/text_layout.h"
#include "mis/report/changes_report.h"

#include <string>

namespace mis {

/// What changed, as a terminal shows it, UTF-8 for ±. Per scene a table of
/// ratios (second report over first), `~` where no change is seen, then a sentence on each strategy
/// that changed; at the end how many did, and the regressions if these were asked for.
std::string changes_text(const Changes& changes, const TextLook& look = {});

}  // namespace mis
