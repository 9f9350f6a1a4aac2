#include "mis/cli/command_line.h"

#include "mis/cli/commands.h"
#include "mis/cli/terminal.h"
#include "mis/cli/usage_check.h"
#include "mis/cli/values.h"
#include "mis/sampling/number_source.h"
#include "mis/strategy/names.h"
#include "mis/strategy/strategy.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace mis::cli {

namespace {

std::string described(const std::vector<Choosable>& list)
{
    std::string text;
    for (const Choosable& c : list) text += fmt::format("  {:<20} {}\n", c.name, c.summary);
    return text;
}

std::string strategy_help()
{
    return "\nA strategy is policy/heuristic[/technique][/one-sample][@LIGHT+BSDF], as in "
           "solid-angle/power or "
           "power/balance/union@4+1; or one that chooses no light: brdf, cosine, "
           "hemisphere; or strata@N: N light draws per point, spread over the lights by what "
           "earlier ones have seen. strata alone has as many as --spp (render) or --at (compare) "
           "says; cost, predict and replay do not take it.\n\nPolicies:\n" +
           described(policy_names()) + "Heuristics:\n" + described(heuristic_names()) +
           "Techniques:\n" + described(technique_names());
}

/// What stands in place of lists that are not given.
std::string default_list()
{
    constexpr std::size_t many_lights = 1'000'000;
    const auto ranked = [](const std::vector<Choosable>& list) {
        return fmt::format("{}", fmt::join(ranked_by_default(list, many_lights, true), ", "));
    };
    return ranked(policy_names()) + ", as far as they may differ on the scene, each with " +
           ranked(heuristic_names()) + "; and " +
           fmt::format("{}", fmt::join(strategies_ranked_by_default(many_lights, true), ", "));
}

void add_threads(CLI::App& command, int& threads)
{
    command.add_option("--threads", threads, "threads to run on (0: as many as the machine has)")
        ->check(whole_number_fault(0, most_threads, "a number of threads"))
        ->type_name("N");
}

void add_seed(CLI::App& command, std::uint64_t& seed)
{
    command.add_option("--seed", seed, "seed of the random numbers")
        ->capture_default_str()
        ->check(whole_number_fault(0, std::numeric_limits<std::uint64_t>::max(), "a seed"))
        ->type_name("N");
}

/// --threads, --seed, --quiet, --resolution, --effects; --sampler where samples are drawn.
void add_run_options(CLI::App& command, RunOptions& options, bool draws_samples = true)
{
    add_threads(command, options.threads);
    add_seed(command, options.seed);
    command
        .add_option("--resolution", options.resolution, "picture size WxH in place of the scene's")
        ->check(empty_fault("a resolution, as in 256x171,"))
        ->type_name("WxH");
    command
        .add_option("--effects", options.effects,
                    "auto: only what the scene and each tile of it call for; all: everything; "
                    "NAME=off: auto, and refused where the scene calls for that effect")
        ->type_name("NAME")
        ->capture_default_str();
    if (draws_samples)
        command
            .add_option("--sampler", options.sampler,
                        "independent: random numbers; sobol: scrambled sequences, whose samples "
                        "spread evenly, as strata has them where this is not given")
            ->each([&options](const std::string&) { options.names_sampler = true; })
            ->type_name("NAME")
            ->capture_default_str();
    command.add_flag("--quiet", options.quiet, "no progress and no remarks on standard error");
}

void add_verbose(CLI::App& command, RunOptions& options)
{
    command.add_flag("--verbose", options.verbose,
                     "every trouble with its reason, not one line for each kind");
}

void add_json_option(CLI::App& command, OutputOptions& options)
{
    command
        .add_option("--json", options.json,
                    "write the figures as JSON to FILE, or - for standard output")
        ->check(empty_fault("a file, or - for standard output,"))
        ->type_name("FILE");
}

void add_output_options(CLI::App& command, OutputOptions& options)
{
    add_json_option(command, options);
    command
        .add_option("--csv", options.csv,
                    "write the figures as CSV to FILE, or - for standard output")
        ->check(empty_fault("a file, or - for standard output,"))
        ->type_name("FILE");
}

void add_samples(CLI::App& command, StopOptions& options, const std::string& what)
{
    command.add_option("--spp", options.spp, what)->check(integer_fault)->type_name("N");
}

void add_time(CLI::App& command, StopOptions& options, const std::string& otherwise = "")
{
    command
        .add_option_function<std::string>(
            "--time", [&options](const std::string& text) { options.seconds = seconds_in(text); },
            "wall time after reading and building trees: seconds, or 500ms, 90s, 2m, 1.5h" +
                otherwise)
        ->check(duration_fault)
        ->type_name("TIME");
}

void add_error(CLI::App& command, StopOptions& options, const std::string& what)
{
    command.add_option("--error", options.error, what)->check(number_fault)->type_name("E");
}

void add_stop_options(CLI::App& command, StopOptions& options, const std::string& error)
{
    add_samples(command, options, "samples per shading point");
    add_time(command, options);
    add_error(command, options, error);
}

/// --policy, --heuristic, --technique, --model, --strategy.
template <class Options> void add_strategy_lists(CLI::App& c, Options& options)
{
    c.add_option("--policy", options.policies, "light-choice policies, separated by commas")
        ->type_name("LIST");
    c.add_option("--heuristic", options.heuristics, "heuristics")->type_name("LIST");
    c.add_option("--technique", options.techniques, "techniques of the light draw")
        ->type_name("LIST");
    c.add_option("--model", options.models, "multi, one-sample")->type_name("LIST");
    c.add_option("--strategy", options.strategies, "strategies by name; with it alone, just these")
        ->type_name("LIST");
}

void add_compare(CLI::App& app, CompareOptions& options)
{
    CLI::App& c = *app.add_subcommand(
        "compare", "rank strategies by variance and by efficiency, on your own scenes");
    c.add_option("scenes", options.scenes,
                 "scene files; or two reports (--json) of earlier runs, the older first")
        ->required()
        ->type_name("SCENE");
    add_strategy_lists(c, options);
    add_samples(c, options.stop,
                "samples per shading point of every strategy; and so many directions that all of "
                "them share, which the variances come from");
    add_time(c, options.stop);
    add_error(c, options.stop, "until every ranked variance is known to ± E (0.05: 5 %)");
    c.add_option_function<std::string>(
         "--at", [&options](const std::string& text) { options.at = numbers_in(text); },
         "samples per point that the efficiency is for; with --sampler sobol, those of one "
         "scrambling, and the variance too is for them. A list 16,64,256: the first ranks, and the "
         "figures are given at each")
        ->check(number_list_fault)
        ->type_name("LIST")
        ->default_str("16");
    c.add_option(
         "--fail-on-regression", options.fail_on_regression,
         "of two reports: exit code 1 where a variance or a cost surely grew by more than P "
         "percent, a mean changed or a strategy is newly biased")
        ->check(number_fault)
        ->type_name("P");
    c.add_option("--out", options.out, "folder for the whole report")
        ->check(empty_fault("a folder"))
        ->type_name("DIR");
    c.add_flag("--force", options.force, "write into a folder that exists");
    c.add_flag("--own-samples", options.own_samples,
               "measure each variance by the strategy's own samples alone, not by directions that "
               "all share");
    c.add_flag("--trap", options.trap,
               "stop at the first sample that is no number, and say how to replay it");
    add_run_options(c, options.run);
    add_verbose(c, options.run);
    add_output_options(c, options.output);
    c.footer([] {
        return "Without a list: " + default_list() +
               ". Without --spp, --time or --error: until it is decided which to use and every "
               "variance is known to 25 %, or 30 s per scene. Two reports: what changed, and how "
               "sure that is.\n\nExamples:\n"
               "  mis compare scenes/veach.json\n"
               "  mis compare scenes/street.json --policy power,radiant-solid-angle --heuristic "
               "light,power --json street-report.json\n"
               "  mis compare scenes/single.json --strategy brdf,uniform/power --spp 256 --csv "
               "-\n"
               "  mis compare old-report.json new-report.json --fail-on-regression 5\n" +
               strategy_help();
    });
}

/// The options given on the line that mean nothing where two reports are compared.
std::vector<std::string> given_for_scenes(const CLI::App& compare)
{
    const std::array<std::string_view, 5> for_reports{"scenes", "--fail-on-regression", "--json",
                                                      "--csv", "--quiet"};
    std::vector<std::string> given;
    for (const CLI::Option* option : compare.get_options())
        if (option->count() > 0 && std::find(for_reports.begin(), for_reports.end(),
                                             option->get_name()) == for_reports.end())
            given.push_back(option->get_name());
    return given;
}

void add_cost(CLI::App& app, CostCommandOptions& options)
{
    CLI::App& c = *app.add_subcommand(
        "cost", "error against time by doubling the samples, and the time to given errors");
    c.add_option("scene", options.scene, "scene file")->required()->type_name("SCENE");
    add_strategy_lists(c, options);
    c.add_option("--precision", options.precisions, "float, double: every strategy in each")
        ->type_name("LIST");
    add_samples(c, options.stop, "samples per shading point of the last doubling");
    add_time(c, options.stop, " (30)");
    add_run_options(c, options.run);
    add_verbose(c, options.run);
    add_output_options(c, options.output);
    c.footer([] {
        return "Without a list: every classic policy with the power heuristic, and brdf; the "
               "soonest to 1 % of them also in double, and with four light draws per BSDF "
               "draw.\n\nExamples:\n"
               "  mis cost scenes/veach.json\n"
               "  mis cost scenes/street.json --strategy power/power,power/power@4+1 --time 60\n"
               "  mis cost scenes/single.json --strategy brdf --precision float,double --csv -\n" +
               strategy_help();
    });
}

void add_render(CLI::App& app, RenderOptions& options)
{
    CLI::App& c = *app.add_subcommand("render", "a picture by one strategy");
    c.add_option("scene", options.scene, "scene file")->required()->type_name("SCENE");
    c.add_option("--strategy", options.strategy,
                 "by name; or `exact`, the closed form, for scenes that have one at every point")
        ->type_name("NAME")
        ->capture_default_str();
    c.add_option("--out", options.out, "OpenEXR file")->required()->type_name("FILE.exr");
    add_stop_options(c, options.stop, "until the relative error of the picture is E");
    add_run_options(c, options.run);
    c.footer([] {
        return "Without --spp, --time or --error: 64 samples per shading point.\n\nExamples:\n"
               "  mis render scenes/veach.json --strategy power/balance --spp 256 --out veach.exr\n"
               "  mis render scenes/hundred.json --error 0.02 --out hundred.exr\n" +
               strategy_help();
    });
}

void add_explain(CLI::App& app, ExplainOptions& options)
{
    CLI::App& c =
        *app.add_subcommand("explain", "what a scene is made of, and which effects it calls for");
    c.add_option("scene", options.scene, "scene file")->required()->type_name("SCENE");
    add_run_options(c, options.run, false);
    add_json_option(c, options.output);
    c.footer(
        "Examples:\n  mis explain scenes/street.json\n  mis explain scenes/street.json --json -");
}

void add_replay(CLI::App& app, ReplayOptions& options)
{
    CLI::App& c = *app.add_subcommand("replay", "one sample again, stage by stage");
    c.add_option("scene", options.scene, "scene file")->required()->type_name("SCENE");
    c.add_option("--strategy", options.strategy, "by name")->required()->type_name("NAME");
    c.add_option("--point", options.point,
                 "number of the shading point: its pixel's, row by row from the top; then the "
                 "probes'")
        ->check(
            whole_number_fault(0, std::numeric_limits<std::uint32_t>::max(), "a point's number"))
        ->type_name("N");
    c.add_option_function<std::string>(
         "--pixel", [&options](const std::string& text) { options.pixel = pixel_in(text); },
         "in place of --point: column and row of a pixel, from 0,0 at the top left")
        ->check(pixel_fault)
        ->type_name("X,Y");
    c.add_option("--sample", options.sample, "number of the sample at that point")
        ->required()
        ->check(
            whole_number_fault(0, std::numeric_limits<std::uint64_t>::max(), "a sample's number"))
        ->type_name("N");
    c.add_option("--at", options.at,
                 "with --sampler sobol: samples of one scrambling, as --at of compare (all of a "
                 "point's, as in render and cost)")
        ->check(whole_number_fault(1, one_scrambling, "a number of samples"))
        ->type_name("N");
    add_run_options(c, options.run);
    c.footer(
        "Examples:\n  mis replay scenes/eclipse.json --strategy power/light --point 20000 "
        "--sample 3\n  mis replay scenes/veach.json --strategy uniform/power --pixel 32,78 "
        "--sample 3");
}

void add_integrate(CLI::App& app, IntegrateOptions& options)
{
    CLI::App& c = *app.add_subcommand(
        "integrate", "the lecture's first example: the integral of cos θ, which is π");
    c.add_option("--pdf", options.pdf, "density of the draws: " + densities())
        ->type_name("NAME")
        ->capture_default_str();
    c.add_option("--exponent", options.exponent, "m of blinn, at least 0 (10)")->type_name("M");
    c.add_option("-n", options.samples, "draws, from 1 to 1e9")
        ->type_name("N")
        ->capture_default_str();
    add_seed(c, options.seed);
    add_output_options(c, options.output);
    c.footer("Densities:\n" + densities_help() +
             "\nExamples:\n  mis integrate\n  mis integrate --pdf angles -n 1e6\n"
             "  mis integrate --pdf blinn --exponent 100\n  mis integrate --pdf cosine --csv -");
}

void add_predict(CLI::App& app, PredictOptions& options)
{
    CLI::App& c = *app.add_subcommand(
        "predict",
        "exact mean and variance of every strategy at a scene's probes, without random numbers");
    c.add_option("scene", options.scene, "scene file with probes")->required()->type_name("SCENE");
    add_strategy_lists(c, options);
    add_threads(c, options.threads);
    c.add_flag("--quiet", options.quiet, "no progress and no remarks on standard error");
    add_output_options(c, options.output);
    c.footer(
        "Each figure stands with a bound of its error. Lights hide one another, spheres among the "
        "surfaces hide "
        "lights; meshes and quads must provably hide none.\n\nExamples:\n"
        "  mis predict scenes/eclipse.json\n"
        "  mis predict scenes/eclipse.json --strategy power/light,power/power/union,brdf\n"
        "  mis predict scenes/overlap.json --policy all --heuristic cutoff,maximum --json -");
}

/// The command line as one would type it again.
std::string typed(int argc, char** argv)
{
    std::string line = "mis";
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool plain =
            !word.empty() && word.find_first_of(" \t\n'\"\\$`*?[](){}<>|&;#~") == std::string::npos;
        std::string quoted = "'";
        for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
        line += " " + (plain ? word : quoted + "'");
    }
    return line;
}

/// The words after the program's name; "help COMMAND" is "COMMAND --help".
std::vector<std::string> words_of(int argc, char** argv)
{
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    if (words.empty() || words[0] != "help") return words;
    if (words.size() == 1 || words[1] == "help" || asks_for_help(words)) return {"--help"};
    if (words.size() > 2)
        throw UsageError(fmt::format("help: found \"{}\" after \"{}\"; it takes one command",
                                     words[2], words[1]));
    return {words[1], "--help"};
}

void print_help(const std::string& text)
{
    fmt::print("{}", fitted(text, look_of_output().columns));
}

/// Prints what is asked for instead of a run: help, or the version.
bool is_answered(CLI::App& app, const std::vector<std::string>& words)
{
    if (words[0] == "--version") return fmt::print("mis {}\n", MIS_VERSION), true;
    if (words[0] == "--help" || words[0] == "-h") return print_help(app.help()), true;
    const CLI::App& command = command_named(app, words[0]);
    if (!asks_for_help(words)) return false;
    return print_help(command.help("mis")), true;
}

}  // namespace

int run_command_line(int argc, char** argv)
{
    CLI::App app(
        "mis ranks the ways to choose a light: direct lighting from spherical sources, by variance "
        "and by time.",
        "mis");
    app.set_version_flag("--version", std::string("mis ") + MIS_VERSION);
    app.require_subcommand(1);
    app.get_formatter()->label("SUBCOMMAND", "COMMAND");
    app.footer(
        "mis COMMAND --help, or mis help COMMAND, shows each command's options and examples.");
    CompareOptions compare;
    CostCommandOptions cost;
    RenderOptions render;
    ExplainOptions explain;
    IntegrateOptions integrate;
    add_compare(app, compare);
    add_cost(app, cost);
    add_render(app, render);
    add_explain(app, explain);
    add_integrate(app, integrate);
    PredictOptions predict;
    add_predict(app, predict);
    ReplayOptions replay;
    add_replay(app, replay);
    for (CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        command->group("Commands");
    const std::vector<std::string> words = words_of(argc, argv);
    if (words.empty())
        throw UsageError("found no command; mis help lists them, mis help COMMAND explains one");
    if (is_answered(app, words)) return ok;
    check_usage(*app.get_subcommand(words[0]), std::span(words).subspan(1));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        throw UsageError(error.what());  // of a value: the option, and its fault
    }
    const std::string line = typed(argc, argv);
    compare.given_for_scenes = given_for_scenes(*app.get_subcommand("compare"));
    if (app.got_subcommand("compare")) return compare.run.command_line = line, run_compare(compare);
    if (app.got_subcommand("cost")) return cost.run.command_line = line, run_cost(cost);
    if (app.got_subcommand("render")) return render.run.command_line = line, run_render(render);
    if (app.got_subcommand("explain")) return explain.run.command_line = line, run_explain(explain);
    if (app.got_subcommand("predict")) return predict.command_line = line, run_predict(predict);
    if (app.got_subcommand("replay")) return replay.run.command_line = line, run_replay(replay);
    return integrate.command_line = line, run_integrate(integrate);
}

}  // namespace mis::cli
