#pragma once

#include "mis/cli/options.h"
#include "mis/report/run_head.h"

namespace mis::cli {

/// What the report of a run with these options says of it; threads are those of the executor.
RunHead run_head(const RunOptions& options);

}  // namespace mis::cli
