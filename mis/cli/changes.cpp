#include "mis/changes/changes.h"
#include "mis/cli/commands.h"
#include "mis/cli/interrupt.h"
#include "mis/cli/terminal.h"
#include "mis/io/atomic_file.h"
#include "mis/io/changes_json.h"
#include "mis/io/changes_text.h"
#include "mis/io/report_peek.h"
#include "mis/io/report_read.h"
#include "mis/io/text_file.h"
#include "mis/words/changes_remarks.h"
#include "mis/words/numbers.h"

#include <fmt/format.h>

#include <algorithm>

namespace mis::cli {

namespace {

/// Throws UsageError unless the files are two reports and every option means something for them.
void check_changes(const CompareOptions& options)
{
    const std::vector<std::string>& files = options.scenes;
    const auto scene = std::find_if_not(files.begin(), files.end(), is_report_file);
    if (scene != files.end()) {
        require_utf8(read_text_file(*scene, "report"), *scene);  // else that is what is wrong
        throw UsageError(fmt::format(
            "{}: found a report among scenes; give scenes alone, or two reports alone\n    {} is "
            "none.",
            *std::find_if(files.begin(), files.end(), is_report_file), *scene));
    }
    if (files.size() != 2)
        throw UsageError(fmt::format(
            "{}: found {}; two are compared, the older and the newer", files[0],
            files.size() == 1 ? "one report" : fmt::format("{} reports", files.size())));
    if (!options.given_for_scenes.empty())
        throw UsageError(
            fmt::format("{}: found with two reports, where it means nothing\n    With reports go "
                        "--fail-on-regression, --json, --csv and --quiet.",
                        listed(options.given_for_scenes)));
    const double percents = options.fail_on_regression.value_or(0);
    if (!(percents >= 0 && percents <= 1e6))
        throw UsageError(
            fmt::format("--fail-on-regression: found {}; 0 to 1e6 percent are allowed", percents));
    check(options.output);
}

}  // namespace

int run_changes(const CompareOptions& options)
{
    check_changes(options);
    ChangesOptions how;
    if (options.fail_on_regression) how.worse_by = *options.fail_on_regression / 100;
    const Report before = read_report(options.scenes[0], interrupt_token()),
                 after = read_report(options.scenes[1], interrupt_token());
    Changes changes = changes_between(before, after, how);
    add_remarks(changes, before, after);
    if (options.fail_on_regression && changes.comparisons == 0 && !changes.has_regression())
        throw UsageError(fmt::format(
            "--fail-on-regression: found no figure that is in both {} and {}\n    Two "
            "runs over the same scenes, with strategies that both ranked, are compared.",
            options.scenes[0], options.scenes[1]));
    const OutputOptions& output = options.output;
    if (output.json != "-" && output.csv != "-")
        fmt::print("{}", changes_text(changes, look_of_output()));
    if (!output.json.empty())
        write_text(output.json, changes_json(changes, {.version = MIS_VERSION,
                                                       .command = options.run.command_line,
                                                       .file_before = options.scenes[0],
                                                       .file_after = options.scenes[1]}));
    if (!output.csv.empty()) write_text(output.csv, changes_csv(changes));
    return changes.has_regression() ? failed : ok;
}

}  // namespace mis::cli
