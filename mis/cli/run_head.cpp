#include "mis/cli/run_head.h"

#include "mis/engine/kernels.h"

namespace mis::cli {

RunHead run_head(const RunOptions& options)
{
    return {.version = MIS_VERSION,
            .command = options.command_line,
            .machine = machine_description(),
            .instruction_set = std::string(kernels<float>().instruction_set),
            .seed = options.seed,
            .is_sobol = options.is_sobol()};
}

}  // namespace mis::cli
