#pragma once

#include "mis/report/changes_report.h"

namespace mis {

/// Adds to `changes` between two reports how the runs and the scenes differ, and what that means
/// for a comparison: version, seed, machine, threads; file, contents, points, samples.
void add_remarks(Changes& changes, const Report& before, const Report& after);

}  // namespace mis
