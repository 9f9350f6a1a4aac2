#include "mis/cli/commands.h"

#include "mis/cli/interrupt.h"
#include "mis/cli/progress.h"
#include "mis/cli/remark.h"
#include "mis/cli/strategy_list.h"
#include "mis/cli/terminal.h"
#include "mis/io/atomic_file.h"
#include "mis/io/predict_json.h"
#include "mis/io/text_layout.h"
#include "mis/words/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

namespace mis::cli {

namespace {

/// The figures of a probe, or why there are none.
PredictReport::Probe predicted(const Scene& scene, const Probe& probe,
                               const std::vector<Strategy>& strategies, const AnyExecutor& executor,
                               const PredictTolerance& tolerance)
{
    try {
        interrupt_token().check();
        return {.figures = predict(scene, probe, strategies, tolerance,
                                   {.executor = &executor, .stop = interrupt_token()}),
                .refusal = {}};
    } catch (const Stopped&) {
        return {.figures = {}, .refusal = "interrupted"};
    } catch (const PredictError& error) {
        return {.figures = {}, .refusal = error.what()};
    }
}

PredictReport::Scene predicted_scene(const Scene& scene, const StrategySelection& selection,
                                     const AnyExecutor& executor, const PredictTolerance& tolerance,
                                     bool quiet)
{
    PredictReport::Scene result{.file = scene.file,
                                .name = scene.name,
                                .lights = scene.lights.size(),
                                .strategies = selection.strategies,
                                .probes = std::vector<PredictReport::Probe>(scene.probes.size())};
    Progress progress(!quiet);
    std::mutex showing;
    std::size_t done = 0;
    progress.show("integrating", 0);
    executor.for_each(scene.probes.size(), [&](std::size_t p) {
        result.probes[p] =
            predicted(scene, scene.probes[p], selection.strategies, executor, tolerance);
        const std::lock_guard lock(showing);
        progress.show("integrating", double(++done) / double(scene.probes.size()));
    });
    return result;
}

}  // namespace

int run_predict(const PredictOptions& options)
{
    const StrategyRequest request =
        read_lists({options.policies, options.heuristics, options.techniques, options.models,
                    options.strategies});
    check(options.output);
    RunOptions run;
    run.threads = options.threads;
    const AnyExecutor executor = make_executor(run);
    const Scene scene = read_scene_for(options.scene, run);
    if (scene.probes.empty())
        throw UsageError(options.scene +
                         ": found no probes; predict answers at probes alone\n"
                         "    Add \"probes\" to the scene (docs/scene-format.md).");
    const StrategySelection selection = select_strategies(request, traits_of(scene));
    if (!options.quiet)
        for (const std::string& reason : selection.left_out) remark("left out: {}\n", reason);
    PredictReport report{
        .version = MIS_VERSION, .command = options.command_line, .threads = executor.threads};
    report.scenes.push_back(
        predicted_scene(scene, selection, executor, report.tolerance, options.quiet));
    report.partial = interrupt_flag();
    const PredictReport::Scene& found = report.scenes.front();
    if (report.partial &&
        std::ranges::all_of(found.probes, [](const auto& probe) { return probe.figures.empty(); }))
        throw Stopped();
    if (options.output.json != "-" && options.output.csv != "-")
        write_text("-", fmt::format("{}: {}, {}\n\n{}",
                                    printable(found.name.empty() ? found.file : found.name),
                                    many(found.probes.size(), "probe"), many(found.lights, "light"),
                                    predict_text(found, look_of_output())));
    if (!options.output.json.empty()) write_text(options.output.json, predict_json(report));
    if (!options.output.csv.empty()) write_text(options.output.csv, predict_csv(report));
    if (report.partial) return interrupted;
    return std::ranges::any_of(found.probes,
                               [](const auto& probe) { return !probe.refusal.empty(); })
               ? failed
               : ok;
}

}  // namespace mis::cli
