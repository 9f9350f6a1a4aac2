#include "mis/cli/commands.h"
#include "mis/cli/predict.h"
#include "mis/io/atomic_file.h"
#include "mis/io/scene_error.h"
#include "mis/scene/nearest_name.h"
#include "mis/strategy/names.h"
#include "mis/strategy/strategy.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace {

using namespace mis::cli;  // NOLINT: the program's own names

std::string names_of(const std::vector<mis::Choosable>& list)
{
    std::string text;
    for (const mis::Choosable& c : list) text += fmt::format("  {:<20} {}\n", c.name, c.summary);
    return text;
}

std::string strategy_help()
{
    return "\nA strategy is policy/heuristic[/technique][/one-sample][@LIGHT+BSDF], as in "
           "solid-angle/power or\n"
           "power/balance/union@4+1; or one that chooses no light: brdf, cosine, "
           "hemisphere.\n\nPolicies:\n" +
           names_of(mis::policy_names()) + "Heuristics:\n" + names_of(mis::heuristic_names()) +
           "Techniques:\n" + names_of(mis::technique_names());
}

void add_compare(CLI::App& app, CompareOptions& options)
{
    CLI::App& c = *app.add_subcommand(
        "compare", "rank strategies by variance and by efficiency, on your own scenes");
    c.add_option("scenes", options.scenes, "scene files; or two reports (.json) of earlier runs")
        ->required()
        ->type_name("SCENE");
    c.add_option("--policy", options.policies, "light-choice policies, separated by commas")
        ->type_name("LIST");
    c.add_option("--heuristic", options.heuristics, "heuristics")->type_name("LIST");
    c.add_option("--technique", options.techniques, "techniques of the light draw")
        ->type_name("LIST");
    c.add_option("--model", options.models, "multi, one-sample")->type_name("LIST");
    c.add_option("--strategy", options.strategies, "strategies by name; with it alone, just these")
        ->type_name("LIST");
    add_stop_options(c, options.stop);
    c.add_option("--at", options.at, "samples per point that the efficiency is for")
        ->type_name("N")
        ->capture_default_str();
    c.add_option("--out", options.out, "folder for the whole report")->type_name("DIR");
    c.add_flag("--force", options.force, "write into a folder that exists");
    add_run_options(c, options.run);
    add_output_options(c, options.output);
    c.footer([] {
        return "Without a list: every policy x light, balance, power, and brdf; until settled, or "
               "30 s per scene.\n\nExamples:\n"
               "  mis compare scenes/veach.json\n"
               "  mis compare scenes/street.json --policy power,radiant-solid-angle --heuristic "
               "light,power --json street-report.json\n"
               "  mis compare scenes/single.json --strategy brdf,uniform/power --spp 256 --csv "
               "-\n" +
               strategy_help();
    });
}

void add_render(CLI::App& app, RenderOptions& options)
{
    CLI::App& c = *app.add_subcommand("render", "a picture by one strategy");
    c.add_option("scene", options.scene, "scene file")->required()->type_name("SCENE");
    c.add_option("--strategy", options.strategy, "by name")
        ->type_name("NAME")
        ->capture_default_str();
    c.add_option("--out", options.out, "OpenEXR file")->required()->type_name("FILE.exr");
    add_stop_options(c, options.stop);
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
    add_run_options(c, options.run);
    add_output_options(c, options.output);
    c.footer("Example:\n  mis explain scenes/street.json");
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
    if (std::find(known.begin(), known.end(), argv[1]) != known.end()) return;
    const std::string_view near = mis::nearest_name(argv[1], known);
    throw UsageError(
        fmt::format("found command \"{}\"; known are {}{}", argv[1], mis::comma_list(known),
                    near.empty() ? "" : fmt::format("\n    Did you mean \"{}\"?", near)));
}

int run(int argc, char** argv)
{
    CLI::App app(
        "mis ranks the ways to choose a light: direct lighting from spherical sources, by variance "
        "and by time.");
    app.set_version_flag("--version", std::string("mis ") + MIS_VERSION);
    app.require_subcommand(1);
    app.footer("mis COMMAND --help shows each command's options and examples.");
    CompareOptions compare;
    RenderOptions render;
    ExplainOptions explain;
    IntegrateOptions integrate;
    add_compare(app, compare);
    add_render(app, render);
    add_explain(app, explain);
    add_integrate(app, integrate);
    PredictOptions predict;
    add_predict(app, predict);
    check_command(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? ok : usage;
    }
    const std::string line = typed(argc, argv);
    if (app.got_subcommand("compare")) return compare.run.command_line = line, run_compare(compare);
    if (app.got_subcommand("render")) return render.run.command_line = line, run_render(render);
    if (app.got_subcommand("explain")) return explain.run.command_line = line, run_explain(explain);
    if (app.got_subcommand("predict")) return predict.command_line = line, run_predict(predict);
    return integrate.command_line = line, run_integrate(integrate);
}

int complain(const char* message, int code)
{
    fmt::print(stderr, "mis: {}\n", message);
    return code;
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        return run(argc, argv);
    } catch (const UsageError& error) {
        return complain(error.what(), usage);
    } catch (const mis::StrategyError& error) {
        return complain(error.what(), usage);
    } catch (const mis::SceneError& error) {
        return complain(error.what(), usage);
    } catch (const std::bad_alloc&) {
        return complain("out of memory", failed);
    } catch (const std::exception& error) {
        return complain(error.what(), failed);
    }
}
