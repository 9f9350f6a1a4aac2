#include "mis/cli/commands.h"
#include "mis/cli/interrupt.h"
#include "mis/cli/memory.h"
#include "mis/cli/progress.h"
#include "mis/cli/ready.h"
#include "mis/cli/remark.h"
#include "mis/cli/report_folder.h"
#include "mis/cli/run_head.h"
#include "mis/cli/strategy_list.h"
#include "mis/cli/terminal.h"
#include "mis/io/report_csv.h"
#include "mis/io/report_json.h"
#include "mis/io/report_peek.h"
#include "mis/io/report_text.h"
#include "mis/stats/overall.h"
#include "mis/study/at_counts.h"
#include "mis/study/maps.h"
#include "mis/study/study.h"
#include "mis/words/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <vector>

namespace mis::cli {

namespace {

/// Ends the run at a sample that is NaN or infinite, and says how to see it again.
[[noreturn]] void trap(const CompareOptions& options, const Scene& scene, const Strategy& strategy,
                       const SampleName& sample, double at)
{
    if (strategy.model == Model::strata)
        throw std::runtime_error(
            fmt::format("{}: {} gave a draw that is no number, at point {}\n    Its draws come "
                        "together, so that none can be replayed.",
                        scene.file, name_of(strategy), sample.point));
    std::string command =
        replay_words(scene.file, strategy, sample) + fmt::format(" --seed {}", options.run.seed);
    if (options.run.is_sobol()) command += fmt::format(" --sampler sobol --at {}", at);
    if (scene.camera)
        command += fmt::format(" --resolution {}x{}", scene.camera->resolution[0],
                               scene.camera->resolution[1]);
    throw std::runtime_error(
        fmt::format("{}: {} gave a sample that is no number; this shows it\n    {}", scene.file,
                    name_of(strategy), command));
}

StudyOptions study_options(const CompareOptions& options, const Scene& scene, Progress& progress)
{
    StudyOptions study;
    study.seed = options.run.seed;
    study.at = options.at.front();
    study.own_samples = options.own_samples;
    study.names_sampler = options.run.names_sampler;
    if (options.run.is_sobol()) study.samples_per_scrambling = static_cast<std::uint64_t>(study.at);
    if (options.stop.spp) study.spp = static_cast<std::uint64_t>(*options.stop.spp);
    study.seconds = options.stop.seconds;
    study.error = options.stop.error;
    study.stop = &interrupt_flag();
    if (options.trap)
        study.on_invalid = [&](const Strategy& strategy, const SampleName& sample, double at) {
            trap(options, scene, strategy, sample, at);
        };
    study.progress = [&progress](double done, const SceneReport& so_far) {
        if (!progress.is_due()) return;
        std::string text = so_far.name.empty() ? so_far.file : so_far.name;
        const StrategyReport* best = nullptr;
        for (const StrategyReport& s : so_far.strategies)
            if (s.rank_by_efficiency == 1) best = &s;
        if (best != nullptr) text += ", ahead: " + name_of(best->strategy);
        progress.show(text, done,
                      so_far.strategies.empty() ? "" : ranking_text(so_far, look_of_errors()));
    };
    return study;
}

/// A variance is measured over scramblings: at least two replicates of two.
void check_scramblings(const CompareOptions& options, double count)
{
    constexpr double most = 65536;
    if (!(count >= 1 && count <= most) || count != std::floor(count))
        throw UsageError(
            fmt::format("--at: found {}; with --sampler sobol it is the samples of one scrambling, "
                        "a whole number from 1 to {}",
                        count, most));
    const auto at = static_cast<std::int64_t>(count);
    if (options.stop.spp && (*options.stop.spp < 4 * at || *options.stop.spp % at != 0))
        throw UsageError(fmt::format(
            "--spp: found {}; with --sampler sobol it is a multiple of --at ({}), and at least {}",
            *options.stop.spp, at, 4 * at));
}

void check_counts(const CompareOptions& options)
{
    constexpr std::size_t most_counts = 16;
    if (options.at.size() > most_counts)
        throw UsageError(fmt::format("--at: found {} numbers; at most {} are allowed",
                                     options.at.size(), most_counts));
    for (auto at = options.at.begin(); at != options.at.end(); ++at) {
        if (!(*at > 0 && *at <= 1e12))
            throw UsageError(
                fmt::format("--at: found {}; more than 0 and at most 1e12 samples per point", *at));
        if (std::find(options.at.begin(), at, *at) != at)
            throw UsageError(fmt::format("--at: found {} twice; each number stands once", *at));
        if (options.run.is_sobol()) check_scramblings(options, *at);
    }
}

void check_options(const CompareOptions& options)
{
    check(options.stop, 4);
    check_counts(options);
    if (options.force && options.out.empty())
        throw UsageError("--force: found without --out DIR, the folder that it is for");
    check(options.output);
}

/// What was left out, each reason once in a run.
using Reasons = std::set<std::string>;
void tell_left_out(const StrategySelection& selection, Reasons& told)
{
    for (const std::string& reason : selection.left_out)
        if (told.insert(reason).second) remark("left out: {}\n", reason);
}

void write_outputs(const CompareOptions& options, const Report& report,
                   std::span<const std::optional<Maps>> maps)
{
    if (!options.output.json.empty()) write_report_json(report, options.output.json);
    if (!options.output.csv.empty()) write_report_csv(report, options.output.csv);
    if (!options.out.empty()) write_report_folder(report, maps, options.out, options.force);
}

std::string no_time_message(const std::string& file, const CompareOptions& options)
{
    return fmt::format(
        "--time: found {} s; in that time not even the shading points of {} were found\n    "
        "Give more time, or a lower --resolution.",
        options.stop.seconds.value_or(StudyOptions().default_seconds), file);
}

bool has_samples(const SceneReport& scene)
{
    return std::any_of(scene.strategies.begin(), scene.strategies.end(),
                       [](const StrategyReport& s) { return s.samples > 0; });
}

/// Compares the strategies on a scene, and shows what was found. Throws Stopped
/// where it was stopped before the first sample.
void add_scene(const std::string& file, const CompareOptions& options,
               const StrategyRequest& request, Progress& progress, Reasons& told, Report& report,
               std::vector<std::optional<Maps>>& maps)
{
    const ReadyScene ready(file, options.run);
    const StrategySelection selection = select_strategies(request, traits_of(ready.scene));
    const std::vector<Strategy>& strategies = selection.strategies;
    check_memory(ready.scene, strategies.size(), !options.out.empty());
    if (!options.run.quiet) tell_left_out(selection, told);
    report.threads = ready.executor.threads;
    if (options.stop.spp)
        ready.lit.expect_samples(static_cast<double>(*options.stop.spp) *
                                 static_cast<double>(strategies.size()));
    Study study = run_study_at(ready.lit, strategies, study_options(options, ready.scene, progress),
                               std::span(options.at).subspan(1), ready.executor);
    progress.clear();
    if (study.points->figure_points == 0) throw UsageError(no_points_message(ready.scene));
    const std::size_t turned = study.points->shading.counts.turned_normals;
    if (turned > 0 && !options.run.quiet) remark("{}", turned_normals_message(turned));
    if (study.report.partial && !has_samples(study.report)) throw Stopped();
    study.report.setup = ready.setup;
    report.scenes.push_back(study.report);
    if (!options.out.empty())
        maps.push_back(
            ready.scene.camera
                ? std::optional(maps_of(ready.lit, study, options.at.front(), ready.executor))
                : std::nullopt);
    report.partial = report.partial || study.report.partial;
    if (options.output.json == "-" || options.output.csv == "-") return;
    fmt::print("{}{}", report.scenes.size() > 1 ? "\n" : "",
               scene_text(report.scenes.back(), report, look_of_output(options.run.verbose)));
    std::fflush(stdout);
}

}  // namespace

int run_compare(const CompareOptions& options)
{
    if (std::any_of(options.scenes.begin(), options.scenes.end(), is_report_file))
        return run_changes(options);
    if (options.fail_on_regression)
        throw UsageError(
            "--fail-on-regression: found scenes; it takes two reports, as --json wrote them: mis "
            "compare OLD.json NEW.json");
    check_options(options);
    StrategyRequest request = read_lists({options.policies, options.heuristics, options.techniques,
                                          options.models, options.strategies});
    request.strata = {.draws = static_cast<int>(std::clamp(std::round(options.at.front()), 1.0,
                                                           double(most_strata_draws))),
                      .spp = options.stop.spp};
    if (!options.out.empty()) check_report_folder(options.out, options.force);
    Report report{run_head(options.run)};
    report.at = options.at.front();
    Reasons told;
    const bool shows_table = options.output.json != "-" && options.output.csv != "-";
    std::vector<std::optional<Maps>> maps;
    Progress progress(!options.run.quiet);
    if (options.scenes.size() > 1)  // a wrong one is found before the first is measured
        for (const std::string& file : options.scenes) {
            const Scene scene = read_scene_for(file, options.run);
            check_memory(scene, select_strategies(request, traits_of(scene)).strategies.size(),
                         !options.out.empty());
        }
    for (const std::string& file : options.scenes) {
        try {
            add_scene(file, options, request, progress, told, report, maps);
        } catch (const Stopped&) {
            if (!interrupt_flag()) throw UsageError(no_time_message(file, options));
            if (report.scenes.empty()) throw;
            report.partial = true;
        }
        if (interrupt_flag()) break;
    }
    report.overall = rank_overall(report.scenes);
    if (shows_table) {
        const std::string overall = overall_text(report, look_of_output(options.run.verbose));
        fmt::print("{}{}", overall.empty() ? "" : "\n", overall);
    }
    write_outputs(options, report, maps);
    return report.partial ? interrupted : ok;
}

}  // namespace mis::cli
