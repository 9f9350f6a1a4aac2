#include "mis/cli/commands.h"
#include "mis/cli/interrupt.h"
#include "mis/cli/memory.h"
#include "mis/cli/progress.h"
#include "mis/cli/ready.h"
#include "mis/cli/remark.h"
#include "mis/cli/run_head.h"
#include "mis/cli/strategy_list.h"
#include "mis/cli/terminal.h"
#include "mis/cost/cost_study.h"
#include "mis/io/atomic_file.h"
#include "mis/io/cost_json.h"
#include "mis/io/cost_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace mis::cli {

namespace {

constexpr std::size_t strategies_of_reference = 4;

void check_options(const CostCommandOptions& options)
{
    check(options.stop, 1);
    constexpr std::int64_t most = std::int64_t{1} << 24;
    if (options.stop.spp && *options.stop.spp > most)
        throw UsageError(
            fmt::format("--spp: found {}; 1 to {} samples per shading point are allowed",
                        *options.stop.spp, most));
    check(options.output);
}

StrategyLists lists_of(const CostCommandOptions& options)
{
    StrategyLists lists{options.policies, options.heuristics, options.techniques, options.models,
                        options.strategies};
    if (!lists.heuristics && lists.has_product()) lists.heuristics = "power,brdf";
    return lists;
}

std::vector<std::string> precisions_of(const CostCommandOptions& options)
{
    return names_listed("--precision", options.precisions, "float", {"float", "double"});
}

std::vector<CostChoice> choices_of(const StrategySelection& selection,
                                   const std::vector<std::string>& precisions)
{
    std::vector<CostChoice> choices;
    for (const std::string& name : precisions)
        for (const Strategy& strategy : selection.strategies) {
            const CostChoice choice{strategy,
                                    name == "double" ? Precision::in_double : Precision::in_float};
            if (std::find(choices.begin(), choices.end(), choice) == choices.end())
                choices.push_back(choice);
        }
    return choices;
}

CostOptions study_options(const CostCommandOptions& options, Progress& progress)
{
    CostOptions study;
    study.seed = options.run.seed;
    study.is_sobol = options.run.is_sobol();
    study.seconds = options.stop.seconds.value_or(study.seconds);
    if (options.stop.spp) study.spp = static_cast<std::uint64_t>(*options.stop.spp);
    study.adds_twins = !options.precisions && !options.strategies;
    study.stop = &interrupt_flag();
    study.progress = [&progress](double done, const std::string& doing) {
        progress.show(doing, done);
    };
    return study;
}

}  // namespace

int run_cost(const CostCommandOptions& options)
{
    check_options(options);
    const StrategyRequest request = read_lists(lists_of(options));
    const std::vector<std::string> precisions = precisions_of(options);
    const ReadyScene ready(options.scene, options.run);
    const StrategySelection selection = select_strategies(request, traits_of(ready.scene));
    const std::vector<CostChoice> choices = choices_of(selection, precisions);
    check_memory(ready.scene, strategies_of_reference);
    if (!options.run.quiet)
        for (const std::string& reason : selection.left_out) remark("left out: {}\n", reason);
    Progress progress(!options.run.quiet);
    CostReport report{run_head(options.run), {}};
    report.threads = ready.executor.threads;
    report.scenes.push_back(
        run_cost_study(ready.lit, choices, study_options(options, progress), ready.executor));
    progress.clear();
    report.scenes.front().setup = ready.setup;
    const CostSceneReport& found = report.scenes.front();
    if (found.shading_points == 0) throw UsageError(no_points_message(ready.scene));
    report.partial = found.partial;
    if (found.partial && std::all_of(found.curves.begin(), found.curves.end(),
                                     [](const auto& curve) { return curve.points.empty(); }))
        throw Stopped();
    if (options.output.json != "-" && options.output.csv != "-")
        write_text("-", cost_text(found, report.threads, look_of_output(options.run.verbose)));
    if (!options.output.json.empty()) write_text(options.output.json, cost_json(report));
    if (!options.output.csv.empty()) write_text(options.output.csv, cost_csv(report));
    return report.partial ? interrupted : ok;
}

}  // namespace mis::cli
