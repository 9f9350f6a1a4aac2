#include "mis/cli/command_line.h"

#include "mis/cli/commands.h"
#include "mis/scene/nearest_name.h"
#include "mis/strategy/names.h"
#include "mis/strategy/strategy.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <functional>
#include <limits>

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
           "solid-angle/power or\n"
           "power/balance/union@4+1; or one that chooses no light: brdf, cosine, "
           "hemisphere.\n\nPolicies:\n" +
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

/// What is wrong with the text of a whole number of that type, or nothing; the parser's own
/// conversion would wrap −1 around.
template <class Number> std::string whole_number_fault(const std::string& text)
{
    Number number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && end == text.data() + text.size()) return "";
    return fmt::format("found \"{}\"; a whole number from 0 to {} is needed", text,
                       std::numeric_limits<Number>::max());
}

/// Likewise of a number that may be negative: the parser's own conversion would cut it off.
std::string samples_fault(const std::string& text)
{
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc{} && end == text.data() + text.size()) return "";
    return fmt::format("found \"{}\"; a whole number of samples is needed", text);
}

/// An empty word, as of a variable that was not set, is not the same as no option.
std::function<std::string(const std::string&)> refuse_empty(const std::string& allowed)
{
    return [allowed](const std::string& text) {
        return text.empty() ? "found \"\"; " + allowed + " is needed" : "";
    };
}

/// --threads, --seed, --quiet, --resolution, --effects; --sampler where samples are drawn.
void add_run_options(CLI::App& command, RunOptions& options, bool draws_samples = true)
{
    command.add_option("--threads", options.threads,
                       "threads to run on (0: as many as the machine has)");
    command.add_option("--seed", options.seed, "seed of the random numbers")
        ->capture_default_str()
        ->check(whole_number_fault<std::uint64_t>);
    command
        .add_option("--resolution", options.resolution, "picture size WxH in place of the scene's")
        ->check(refuse_empty("a resolution, as in 256x171,"));
    command
        .add_option("--effects", options.effects,
                    "auto: only what the scene and each tile of it call for; all: everything; "
                    "NAME=off: auto, and refused where the scene calls for that effect")
        ->capture_default_str();
    if (draws_samples)
        command
            .add_option("--sampler", options.sampler,
                        "independent: random numbers; sobol: scrambled sequences, whose samples "
                        "spread evenly")
            ->capture_default_str();
    command.add_flag("--quiet", options.quiet, "no progress and no remarks on standard error");
}

void add_json_option(CLI::App& command, OutputOptions& options)
{
    command
        .add_option("--json", options.json,
                    "write the figures as JSON to FILE, or - for standard output")
        ->check(refuse_empty("a file, or - for standard output,"))
        ->type_name("FILE");
}

void add_output_options(CLI::App& command, OutputOptions& options)
{
    add_json_option(command, options);
    command
        .add_option("--csv", options.csv,
                    "write the figures as CSV to FILE, or - for standard output")
        ->check(refuse_empty("a file, or - for standard output,"))
        ->type_name("FILE");
}

void add_stop_options(CLI::App& command, StopOptions& options, const std::string& error)
{
    command.add_option("--spp", options.spp, "samples per shading point")
        ->check(samples_fault)
        ->type_name("N");
    command
        .add_option("--time", options.seconds,
                    "seconds of wall time, after reading and building trees")
        ->type_name("S");
    command.add_option("--error", options.error, error)->type_name("E");
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
    add_stop_options(c, options.stop, "until every ranked variance is known to ± E (0.05: 5 %)");
    c.add_option("--at", options.at,
                 "samples per point that the efficiency is for; with --sampler sobol, those of one "
                 "scrambling, and the variance too is for them")
        ->type_name("N")
        ->capture_default_str();
    c.add_option(
         "--fail-on-regression", options.fail_on_regression,
         "of two reports: exit code 1 where a variance or a cost surely grew by more than P "
         "percent, a mean changed or a strategy is newly biased")
        ->type_name("P");
    c.add_option("--out", options.out, "folder for the whole report")
        ->check(refuse_empty("a folder"))
        ->type_name("DIR");
    c.add_flag("--force", options.force, "write into a folder that exists");
    c.add_flag("--trap", options.trap,
               "stop at the first sample that is no number, and say how to replay it");
    add_run_options(c, options.run);
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
    c.add_option("--spp", options.stop.spp, "samples per shading point of the last doubling")
        ->check(samples_fault)
        ->type_name("N");
    c.add_option("--time", options.stop.seconds,
                 "seconds of wall time, after reading and building trees (30)")
        ->type_name("S");
    add_run_options(c, options.run);
    add_output_options(c, options.output);
    c.footer([] {
        return "Without a list: every classic policy with the power heuristic, and brdf; the "
               "soonest to 1 % of them also in\ndouble, and with four light draws per BSDF "
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
                 "number of the shading point: its pixel's; probes follow")
        ->required()
        ->check(whole_number_fault<std::uint32_t>)
        ->type_name("N");
    c.add_option("--sample", options.sample, "number of the sample at that point")
        ->required()
        ->check(whole_number_fault<std::uint64_t>)
        ->type_name("N");
    c.add_option("--at", options.at,
                 "with --sampler sobol: samples of one scrambling, as --at of compare (all of a "
                 "point's, as in render and cost)")
        ->check(whole_number_fault<std::uint64_t>)
        ->type_name("N");
    add_run_options(c, options.run);
    c.footer(
        "Example:\n  mis replay scenes/eclipse.json --strategy power/light --point 20000 "
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
    c.add_option("--seed", options.seed, "seed of the random numbers")
        ->check(whole_number_fault<std::uint64_t>)
        ->capture_default_str();
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
    c.add_option("--threads", options.threads, "threads to run on (0: as many as the machine has)");
    c.add_flag("--quiet", options.quiet, "no progress and no remarks on standard error");
    add_output_options(c, options.output);
    c.footer(
        "Each figure stands with a bound of its error. Lights hide one another, spheres among the "
        "surfaces hide\n"
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

/// Throws UsageError where the first word is no command.
void check_command(const CLI::App& app, int argc, char** argv)
{
    if (argc < 2 || argv[1][0] == '-') return;
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(command->get_name());
    const std::vector<std::string_view> known(names.begin(), names.end());
    if (std::find(known.begin(), known.end(), argv[1]) == known.end())
        refuse_name("found command", argv[1], known);
}

/// Throws UsageError where a word looks like an option, and the command has none of that name.
void check_options_known(const CLI::App& command, int argc, char** argv)
{
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    const std::vector<std::string_view> known(names.begin(), names.end());
    for (int i = 2; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--") return;
        const std::string name = word.substr(0, word.find('='));
        if (!word.starts_with("--") || std::find(known.begin(), known.end(), name) != known.end())
            continue;
        refuse_name(command.get_name() + ": found option", name, known);
    }
}

}  // namespace

int run_command_line(int argc, char** argv)
{
    CLI::App app(
        "mis ranks the ways to choose a light: direct lighting from spherical sources, by variance "
        "and by time.");
    app.set_version_flag("--version", std::string("mis ") + MIS_VERSION);
    app.require_subcommand(1);
    app.footer("mis COMMAND --help shows each command's options and examples.");
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
    check_command(app, argc, argv);
    if (argc > 1 && argv[1][0] != '-')
        check_options_known(*app.get_subcommand(argv[1]), argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? ok : usage;
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
