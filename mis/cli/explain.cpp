#include "mis/cli/commands.h"
#include "mis/cli/ready.h"
#include "mis/cli/terminal.h"
#include "mis/io/explain_report.h"

#include <fmt/format.h>

namespace mis::cli {

int run_explain(const ExplainOptions& options)
{
    check(options.output);
    const ReadyScene ready(options.scene, options.run);
    const Explanation explanation =
        explain(ready.lit, ready.stoppable_executor(), interrupt_token());
    if (options.output.json != "-")
        fmt::print("{}", explanation_text(explanation, look_of_output()));
    if (!options.output.json.empty())
        write_explanation_json(explanation,
                               {.command = options.run.command_line,
                                .seed = options.run.seed,
                                .threads = ready.executor.threads},
                               options.output.json);
    return ok;
}

}  // namespace mis::cli
