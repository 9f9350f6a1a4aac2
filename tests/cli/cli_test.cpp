#include "tests/cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace mis {
namespace {

struct BadLine {
    const char* words;
    const char* message;  ///< that standard error must hold
};

TEST(CommandLine, AnswersWhatIsWrongWithOneMessageAndExitCode2)
{
    const std::string veach = scene("veach");
    const std::array lines{
        BadLine{"frob", "found command \"frob\""},
        BadLine{"compar", "Did you mean \"compare\""},
        BadLine{"compare", "mis: compare: found no SCENE; it needs"},
        BadLine{"compare /no/such.json", "no such file"},
        BadLine{"compare .", "found a directory"},
        BadLine{"replay VEACH --strategy brdf --point 20000 --sample -1", "found \"-1\""},
        BadLine{"replay VEACH --strategy brdf --point 99999999 --sample 1", "no point of"},
        BadLine{"compare VEACH --policy powr", "Did you mean \"power\""},
        BadLine{"compare VEACH --heuristic balanced", "Did you mean \"balance\""},
        BadLine{"compare VEACH --strategy uniform/brdf", "say \"brdf\""},
        BadLine{"compare VEACH --strategy all/power/one-sample", "draws for every light"},
        BadLine{"compare VEACH --strategy ,", "names separated by commas"},
        BadLine{"compare VEACH --spp 0", "--spp: found 0"},
        BadLine{"compare VEACH --spp 99999999999999999999", "found \"99999999999999999999\""},
        BadLine{"compare VEACH --spp 1e3", "found \"1e3\""},
        BadLine{"compare VEACH --spp 8 --json ''", "--json: found \"\""},
        BadLine{"compare VEACH --spp 8 --csv ''", "--csv: found \"\""},
        BadLine{"compare VEACH --spp 8 --out ''", "--out: found \"\""},
        BadLine{"compare VEACH --resolution ''", "--resolution: found \"\""},
        BadLine{"compare VEACH --spp 8 --time 2", "found more than one"},
        BadLine{"compare VEACH --time -1", "--time: found -1"},
        BadLine{"compare VEACH --error 0", "--error: found 0"},
        BadLine{"compare VEACH --at 0", "--at: found 0"},
        BadLine{"compare VEACH --at 16,64,0", "--at: found 0"},
        BadLine{"compare VEACH --at 16,,64", "--at: found \"\"; a number is needed"},
        BadLine{"compare VEACH --at 16,64,16", "--at: found 16 twice"},
        BadLine{"compare VEACH --sampler sobol --at 16,2.5", "a whole number from 1"},
        BadLine{"compare VEACH --sampler sobol --at 16,64 --spp 96", "a multiple of --at (64)"},
        BadLine{"compare VEACH --seed -1", "found \"-1\""},
        BadLine{"compare VEACH --threads -3", "--threads: found \"-3\""},
        BadLine{"compare VEACH --resolution 0x4", "--resolution: found \"0x4\""},
        BadLine{"compare VEACH --resolution 99999x4", "--resolution: found"},
        BadLine{"compare VEACH --effects some", "--effects: found \"some\""},
        BadLine{"compare VEACH --effects al", "Did you mean \"all\""},
        BadLine{"compare VEACH --effects shadow=off", "Did you mean \"shadows=off\""},
        BadLine{"compare VEACH --effects horizon", "Did you mean \"horizon=off\""},
        BadLine{"explain VEACH --effects atuo", "Did you mean \"auto\""},
        BadLine{"render VEACH --sampler sobel --out x.exr", "Did you mean \"sobol\""},
        BadLine{"compare VEACH --model multy", "Did you mean \"multi\""},
        BadLine{"cost VEACH --precision flaot", "Did you mean \"float\""},
        BadLine{"predict VEACH --technique projekted", "Did you mean \"projected\""},
        BadLine{"compare VEACH --polcy power", "Did you mean \"--policy\""},
        BadLine{"render VEACH --sp 4 --out x.exr", "Did you mean \"--spp\""},
        BadLine{"integrate --pdv=cosine", "Did you mean \"--pdf\""},
        BadLine{"explian VEACH", "Did you mean \"explain\""},
        BadLine{"explain VEACH --csv -", "explain: found option \"--csv\"; known are"},
        BadLine{"explain VEACH --sampler sobol", "explain: found option \"--sampler\"; known are"},
        BadLine{"compare VEACH --effects lobes=off", "--effects: found \"lobes=off\""},
        BadLine{"compare VEACH --effects shadows=off", "% of the tiles"},
        BadLine{"render VEACH --effects light_occlusion=off --out x.exr", "before one another"},
        BadLine{"compare VEACH --sampler halton", "--sampler: found \"halton\""},
        BadLine{"compare VEACH --sampler sobol --at 1.5", "a whole number from 1"},
        BadLine{"compare VEACH --sampler sobol --at 16 --spp 40", "a multiple of --at (16)"},
        BadLine{"compare VEACH --sampler sobol --spp 48", "at least 64"},
        BadLine{"replay VEACH --strategy brdf --point 20000 --sample 1 --at 16", "--sampler sobol"},
        BadLine{"compare VEACH --spp 8 --json - --csv -", "standard output takes one"},
        BadLine{"compare VEACH --spp 8 --json /no/such/folder/x.json", "there is no folder"},
        BadLine{"compare VEACH --spp 8 --out /no/such/folder/x", "there is no folder"},
        BadLine{"compare VEACH --resolution 16384x16384", "GB"},
        BadLine{"render VEACH", "mis: render: found no --out; it needs --out FILE.exr"},
        BadLine{"render VEACH --out x.png", "ends in .exr"},
        BadLine{"render VEACH --out ''", "ends in .exr"},
        BadLine{"compare VEACH --strategy ''", "--strategy: found \"\""},
        BadLine{"compare VEACH no-such.json --spp 8", "no-such.json: found no such file"},
        BadLine{"predict VEACH --json /no/such/x.json", "there is no folder"},
        BadLine{"integrate --json /no/such/x.json", "there is no folder"},
        BadLine{"render VEACH --out /no/such/x.exr", "there is no folder"},
        BadLine{"render VEACH --strategy brdff --out x.exr", "Did you mean \"brdf\""},
        BadLine{"cost VEACH --json x.out --csv ./x.out", "a file takes one of them"},
        BadLine{"render VEACH --strategy exact --out x.exr", "have a closed form, and all must"},
        BadLine{"render VEACH --strategy exact --spp 4 --out x.exr", "takes no samples"},
        BadLine{"render VEACH --strategy exact --effects all --out x.exr", "--effects auto"},
        BadLine{"cost", "mis: cost: found no SCENE"},
        BadLine{"cost VEACH --strategy powr/power", "Did you mean \"power\""},
        BadLine{"cost VEACH --precision half", "--precision: found \"half\""},
        BadLine{"cost VEACH --precision float,", "names separated by commas"},
        BadLine{"cost VEACH --spp 0", "--spp: found 0"},
        BadLine{"cost VEACH --spp 99999999", "--spp: found 99999999"},
        BadLine{"render VEACH --strategy strata@0 --out x.exr", "1 to 65536, as in strata@64"},
        BadLine{"render VEACH --strategy strata@64 --spp 100 --out x.exr", "some whole number"},
        BadLine{"compare VEACH --strategy strata/light", "\"strata\" stands alone"},
        BadLine{"compare VEACH --strategy strata@64 --spp 128", "at least 256; found 128"},
        BadLine{"compare VEACH --strategy strata@64 --spp 300", "multiple of 64"},
        BadLine{"cost VEACH --strategy strata", "`mis compare` has"},
        BadLine{"replay VEACH --strategy strata@4 --sample 0 --pixel 1,1", "none stands by itself"},
        BadLine{"cost VEACH --spp 8 --time 2", "found more than one"},
        BadLine{"cost VEACH --time 0", "--time: found 0"},
        BadLine{"cost VEACH --error 0.1", "--error"},
        BadLine{"cost VEACH b", "found \"b\" after"},
        BadLine{"cost VEACH --json - --csv -", "standard output takes one"},
        BadLine{"integrate --pdf cosin", "Did you mean \"cosine\""},
        BadLine{"integrate --pdf hemi", "Did you mean \"hemisphere\""},
        BadLine{"integrate -n 0", "found"},
    };
    for (const BadLine& line : lines) {
        std::string words = line.words;
        if (const std::size_t at = words.find("VEACH"); at != std::string::npos)
            words.replace(at, 5, "'" + veach + "'");
        const Outcome outcome = mis_with(words);
        EXPECT_EQ(outcome.exit, 2) << line.words << "\n" << outcome.error;
        EXPECT_NE(outcome.error.find(line.message), std::string::npos) << line.words << "\n"
                                                                       << outcome.error;
        EXPECT_EQ(outcome.error.rfind("mis: ", 0), 0U) << line.words << "\n" << outcome.error;
        EXPECT_EQ(outcome.out, "") << line.words;
    }
}

/// A report of `mis compare` on a small scene.
std::string report_by(const TemporaryFolder& folder, const std::string& name,
                      const std::string& options)
{
    const std::string file = (folder / name).string();
    const Outcome run =
        mis_with("compare '" + scene("overlap") +
                 "' --resolution 16x12 --spp 1024 --strategy power/balance,power/light " + options +
                 " --quiet --json '" + file + "'");
    EXPECT_EQ(run.exit, 0) << run.error;
    return file;
}

TEST(CommandLine, ComparesTwoReports)
{
    const TemporaryFolder folder;
    const std::string old_file = report_by(folder, "old.json", "--seed 1"),
                      new_file = report_by(folder, "new.json", "--seed 2"),
                      both = "compare '" + old_file + "' '" + new_file + "'";
    const Outcome outcome = mis_with(both);
    EXPECT_EQ(outcome.exit, 0) << outcome.error;
    EXPECT_NE(outcome.out.find("The runs differ: seed 1, then 2."), std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("power/balance"), std::string::npos) << outcome.out;
    EXPECT_EQ(mis_with(both + " --csv -").out.rfind("scene,file_before,", 0), 0U);

    auto worse = nlohmann::json::parse(text_of(old_file));
    for (auto& part : worse["scenes"][0]["strategies"][0]["variance"])
        part = 2 * part.get<double>();
    const std::string worse_file = folder.write("worse.json", worse.dump()).string(),
                      to_worse = "compare '" + old_file + "' '" + worse_file + "' --json - ";
    const Outcome failing = mis_with(to_worse + "--fail-on-regression 20");
    EXPECT_EQ(failing.exit, 1) << failing.error;
    EXPECT_EQ(nlohmann::json::parse(failing.out)["regression"], true);
    EXPECT_EQ(mis_with(to_worse).exit, 0);

    auto elsewhere = nlohmann::json::parse(text_of(old_file));
    elsewhere["scenes"][0]["name"] = elsewhere["scenes"][0]["file"] = "another";
    const std::string other_file = folder.write("other.json", elsewhere.dump()).string(),
                      to_other = "compare '" + old_file + "' '" + other_file + "'";
    EXPECT_EQ(mis_with(to_other).exit, 0);
    const Outcome nothing = mis_with(to_other + " --fail-on-regression 20");
    EXPECT_EQ(nothing.exit, 2);
    EXPECT_NE(nothing.error.find("found no figure that is in both"), std::string::npos);
    EXPECT_EQ(mis_with(to_worse + "--fail-on-regression 200").exit, 0);
    EXPECT_EQ(
        mis_with("compare '" + worse_file + "' '" + old_file + "' --fail-on-regression 0").exit, 0);
}

TEST(CommandLine, AnswersWhatIsWrongWithReportsWithOneMessageAndExitCode2)
{
    const TemporaryFolder folder;
    const std::string report = report_by(folder, "a.json", ""), one = "'" + report + "' ",
                      torn = "'" +
                             folder.write("torn.json", text_of(report).substr(0, 2000)).string() +
                             "' ",
                      veach = "'" + scene("veach") + "' ";
    std::string wide = "\xFF\xFE";
    for (const char c : text_of(report)) wide += c, wide += '\0';
    const std::string utf16 = "'" + folder.write("utf16.json", wide).string() + "' ";
    const std::array<std::pair<std::string, std::string>, 11> lines{{
        {one + utf16, "utf16.json: found UTF-16 text (little-endian)"},
        {utf16 + utf16, "utf16.json: found UTF-16 text (little-endian)"},
        {one + "no-such.json", "no-such.json: found no such file"},
        {one, "found one report"},
        {one + one + one, "found 3 reports"},
        {one + veach, "a report among scenes"},
        {one + torn, "line "},
        {one + one + "--spp 8 --seed 2", "--spp and --seed: found with two reports"},
        {one + one + "--fail-on-regression -1", "--fail-on-regression: found -1"},
        {one + one + "--fail-on-regression nan", "--fail-on-regression: found nan"},
        {veach + "--fail-on-regression 5", "--fail-on-regression: found scenes"},
    }};
    for (const auto& [words, message] : lines) {
        const Outcome outcome = mis_with("compare " + words);
        EXPECT_EQ(outcome.exit, 2) << words << outcome.error;
        EXPECT_NE(outcome.error.find(message), std::string::npos) << words << outcome.error;
        EXPECT_EQ(outcome.out, "") << words;
    }
}

TEST(CommandLine, HelpsOnEveryCommand)
{
    for (const char* command :
         {"", "compare", "cost", "render", "explain", "integrate", "predict", "replay"}) {
        const Outcome outcome = mis_with(std::string(command) + " --help");
        EXPECT_EQ(outcome.exit, 0);
        EXPECT_NE(outcome.out.find(command[0] == '\0' ? "COMMAND --help" : "Example"),
                  std::string::npos)
            << outcome.out;
    }
    EXPECT_EQ(mis_with("--version").out.rfind("mis ", 0), 0U);
}

TEST(CommandLine, GivesTheSameFiguresOnAnyNumberOfThreads)
{
    const std::string words = "compare '" + scene("veach") +
                              "' --resolution 32x24 --spp 32 --strategy "
                              "power/balance,all/light,brdf,strata@8 --json - --quiet --threads ";
    const auto figures = [&](int threads) {
        const Outcome outcome = mis_with(words + std::to_string(threads));
        EXPECT_EQ(outcome.exit, 0) << outcome.error;
        std::string text;
        const auto report = nlohmann::json::parse(outcome.out);
        for (const auto& s : report["scenes"][0]["strategies"])
            text += s["mean"].dump() + s["variance"]["value"].dump() +
                    s["relative_variance"]["value"].dump() + s["samples"].dump() +
                    s["status"].dump() + "\n";
        return text;
    };
    const std::string one = figures(1);
    EXPECT_EQ(figures(2), one);
    EXPECT_EQ(figures(3), one);
}

TEST(CommandLine, FindsEveryShippedSceneLitAndFinite)
{
    for (const char* name : {"veach", "veach-blinn", "single", "lecture", "hundred", "overlap",
                             "eclipse", "horizon", "sun-and-lamp", "street"}) {
        const Outcome outcome = mis_with(
            "compare '" + scene(name) +
            "' --resolution 24x16 --spp 16 --policy power,radiant-solid-angle --json - --quiet");
        ASSERT_EQ(outcome.exit, 0) << name << outcome.error;
        const auto report = nlohmann::json::parse(outcome.out);
        for (const auto& s : report["scenes"][0]["strategies"]) {
            EXPECT_EQ(s["invalid_samples"], 0) << name;
            if (s["name"] == "brdf") continue;  // may meet no light in so few draws
            EXPECT_GT(s["mean"].get<double>(), 0) << name;
        }
        const Outcome others = mis_with(
            "compare '" + scene(name) +
            "' --resolution 24x16 --spp 16 --json - --quiet --strategy uniform/maximum,all/cutoff,"
            "solid-angle/balance/union,irradiance/power/projected,product/cutoff/one-sample,"
            "tree/maximum/projected/one-sample,uniform/power/union/one-sample,cosine,hemisphere");
        ASSERT_EQ(others.exit, 0) << name << others.error;
        const auto of_others = nlohmann::json::parse(others.out);
        ASSERT_EQ(of_others["scenes"][0]["strategies"].size(), 9U) << name;
        for (const auto& s : of_others["scenes"][0]["strategies"])
            EXPECT_EQ(s["invalid_samples"], 0) << name << " " << s["name"];
    }
}

TEST(CommandLine, MeasuresErrorAgainstTime)
{
    const Outcome outcome =
        mis_with("cost '" + scene("single") +
                 "' --resolution 24x16 --spp 16 --strategy power/power,power/power@4+1 "
                 "--precision float,double --quiet --json -");
    ASSERT_EQ(outcome.exit, 0) << outcome.error;
    EXPECT_EQ(outcome.error, "");
    const auto found = nlohmann::json::parse(outcome.out)["scenes"][0];
    EXPECT_EQ(found["reference"]["kind"], "pooled");
    ASSERT_EQ(found["strategies"].size(), 4U);
    for (const auto& s : found["strategies"]) {
        ASSERT_EQ(s["points"].size(), 5U);
        EXPECT_EQ(s["points"][4]["samples"], 16);
        EXPECT_NEAR(s["slope"]["value"].get<double>(), -0.5, 0.05);
    }
    EXPECT_EQ(found["strategies"][3]["name"], "power/power@4+1");
    EXPECT_EQ(found["strategies"][3]["precision"], "double");
}

TEST(CommandLine, MeasuresErrorAtProbesAgainstQuadrature)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "probe.json").string();
    std::ofstream(file) << R"({ "format": "mis-scene/1",
        "probes": [{ "position": [0,0,0], "normal": [0,1,0], "outgoing": [0,1,0], "material": "m" }],
        "materials": { "m": { "type": "lambert", "albedo": 0.5 } },
        "lights": [{ "center": [0,2,0], "radius": 0.5, "power": 100 },
                   { "center": [2,2,0], "radius": 0.1, "power": 300 }] })";
    const Outcome outcome =
        mis_with("cost '" + file + "' --spp 8 --policy uniform,power --quiet --csv -");
    ASSERT_EQ(outcome.exit, 0) << outcome.error;
    // Two policies with the power heuristic and brdf, in float; and the twins of the soonest.
    for (const char* part :
         {",uniform/power,float,point,8,", ",power/power,float,point,8,", ",brdf,float,point,8,",
          ",double,point,8,", "/power@4+1,float,point,8,"})
        EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
    const Outcome table = mis_with("cost '" + file + "' --spp 8 --strategy power/light --quiet");
    EXPECT_NE(table.out.find("exact, by quadrature"), std::string::npos) << table.out;
    EXPECT_NE(table.out.find("time to"), std::string::npos) << table.out;
}

TEST(CommandLine, RendersAPictureOrNothing)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "a.exr").string();
    EXPECT_EQ(
        mis_with("render '" + scene("single") + "' --resolution 16x12 --spp 4 --out '" + file + "'")
            .exit,
        0);
    EXPECT_TRUE(std::filesystem::exists(file));
    const std::string bytes = text_of(file);
    for (const char* name : {"mis:command", "mis:seed", "mis:strategy", "mis:sampler",
                             "mis:samples_per_point", "mis:partial", "Software"})
        EXPECT_NE(bytes.find(name), bytes.npos) << name;
    EXPECT_EQ(bytes.find("mis/seed"), bytes.npos);
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder / ""))
        ++files;
    EXPECT_EQ(files, 1U);
}

TEST(CommandLine, RendersAllSamplesOfThoseThatComeTogether)
{
    const TemporaryFolder folder;
    const std::string render = "render '" + scene("eclipse") + "' --resolution 16x12 --out '" +
                               (folder / "a.exr").string();
    for (const char* options : {"' --strategy strata@12 --spp 24", "' --strategy strata@6 --spp 24",
                                "' --strategy strata --spp 24", "' --strategy strata@8 --spp 24"}) {
        const Outcome run = mis_with(render + options);
        EXPECT_EQ(run.exit, 0) << run.error;
        EXPECT_NE(run.error.find("24 samples each by strata"), run.error.npos) << run.error;
    }
}

TEST(CommandLine, RendersTheClosedFormWhereThereIsOne)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "exact.exr").string();
    const Outcome run = mis_with("render '" + scene("single") +
                                 "' --resolution 48x32 --strategy exact --out '" + file + "'");
    EXPECT_EQ(run.exit, 0) << run.error;
    EXPECT_NE(run.error.find("each by its closed form"), std::string::npos) << run.error;
    EXPECT_TRUE(std::filesystem::exists(file));
}

TEST(CommandLine, FailsWithExitCode1OnAFullDisk)
{
    const Outcome outcome = mis_with("compare '" + scene("single") +
                                     "' --resolution 8x8 --spp 4 --quiet --json /dev/full");
    EXPECT_EQ(outcome.exit, 1) << outcome.error;
    EXPECT_NE(outcome.error.find("/dev/full"), std::string::npos) << outcome.error;
}

/// Exit code of the program with these words and redirections.
int exit_of(const std::string& words)
{
    const int status = std::system(("'" + program_file().string() + "' " + words).c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(CommandLine, FailsWithExitCode1WhereStandardOutputCannotBeWritten)
{
    const TemporaryFolder folder;
    const std::string error = (folder / "error").string(), said = " 2>'" + error + "'";
    const std::string single = "'" + scene("single") + "' --resolution 8x8 ";
    for (const std::string& words :
         {"compare " + single + "--spp 16 --quiet --strategy uniform/light",
          "replay " + single + "--strategy uniform/light --point 40 --sample 0",
          "explain " + single, "predict '" + scene("single") + "' --strategy brdf",
          std::string("integrate -n 10"), std::string("--help")}) {
        EXPECT_EQ(exit_of(words + " >/dev/full" + said), 1) << words;
        EXPECT_NE(text_of(error).find("standard output: cannot be written"), std::string::npos)
            << words << "\n"
            << text_of(error);
    }
    EXPECT_EQ(exit_of("explain " + single + ">&-" + said), 1);
}

/// A scene's name comes from a file: it is shown, and does not play on the terminal.
TEST(CommandLine, PrintsNoControlCharacterOfAName)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "scene.json").string();
    std::ofstream(file)
        << R"({"format": "mis-scene/1", "name": "lamp\u001b[31m", "materials": {"m\u001b[2J": {"type": "lambert", "albedo": 0.5}},
        "probes": [{"position": [0, 0, 0], "normal": [0, 1, 0], "outgoing": [0, 1, 0], "material": "m\u001b[2J"}],
        "lights": [{"center": [0, 2, 0], "radius": 0.5, "radiance": 1}]})";
    for (const std::string command :
         {"explain", "predict", "compare --spp 16", "cost --spp 16 --strategy uniform/light"}) {
        const Outcome run = mis_with(command + " '" + file + "' --quiet");
        EXPECT_EQ(run.exit, 0) << command << "\n" << run.error;
        EXPECT_EQ(run.out.find('\x1b'), std::string::npos) << command << "\n" << run.out;
        EXPECT_NE(run.out.find("lamp\\u001b[31m"), std::string::npos) << command << "\n" << run.out;
    }
}

/// What cannot be said changes no result, and no exit code.
TEST(CommandLine, GoesOnWhereStandardErrorCannotBeWritten)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "a.exr").string();
    const std::string render =
        "render '" + scene("single") + "' --resolution 8x8 --spp 4 --out '" + file + "'";
    for (const char* error : {" 2>/dev/full", " 2>&-"}) {
        EXPECT_EQ(exit_of("compare /no/such.json" + std::string(error)), 2) << error;
        EXPECT_EQ(exit_of(render + error), 0) << error;
        EXPECT_TRUE(std::filesystem::remove(file)) << error;
    }
}

/// The scene comes through a pipe that is not closed: the program has read from it, as more was
/// written than a pipe holds, and waits for more when the signal comes.
TEST(CommandLine, EndsOnASignalWhileItReads)
{
    for (const char* signal : {"INT", "TERM"})
        for (const char* words :
             {"compare pipe", "render pipe --strategy brdf --out o.exr", "cost pipe",
              "explain pipe", "predict pipe", "replay pipe --strategy brdf --point 0 --sample 0"}) {
            const TemporaryFolder folder;
            const std::string script =
                "cd '" + (folder / ".").string() + "'; mkfifo pipe; exec 3<>pipe; '" +
                program_file().string() + "' " + words +
                " >out 2>error 3>&- & p=$!; printf '%300000s' '' >&3; kill -" + signal +
                " $p; exec 3>&-; wait $p";
            const int status = std::system(script.c_str());
            EXPECT_EQ(WEXITSTATUS(status), 130) << words;
            EXPECT_EQ(text_of((folder / "out").string()), "") << words;
            EXPECT_NE(text_of((folder / "error").string())
                          .find("interrupted before there was a result; nothing was written"),
                      std::string::npos)
                << words;
        }
}

TEST(CommandLine, ReplaysASampleStageByStage)
{
    const Outcome run =
        mis_with("replay " + scene("veach") + " --strategy uniform/power --point 20000 --sample 3");
    EXPECT_EQ(run.exit, 0) << run.error;
    for (const char* words :
         {"random numbers", "direction", "light_occlusion", "value in float", "value in double"})
        EXPECT_NE(run.out.find(words), std::string::npos) << words << "\n" << run.out;
}

/// One sample in a thousand hits the light of this scene: a few hits are no error of 24 %.
TEST(CommandLine, RenderDoesNotTrustAnErrorThatFewSamplesCarry)
{
    const TemporaryFolder folder;
    const std::string file = (folder / "scene.json").string();
    std::ofstream(file)
        << R"({"format": "mis-scene/1", "materials": {"m": {"type": "lambert", "albedo": 0.5}},
        "camera": {"position": [0, 2, 4], "target": [0, 0, 0], "resolution": [24, 16]},
        "surfaces": [{"type": "quad", "corner": [-4, 0, 4], "edges": [[8, 0, 0], [0, 0, -8]], "material": "m"}],
        "lights": [{"center": [0, 2, 0], "radius": 0.05, "radiance": 1}]})";
    const std::string out = " --out '" + (folder / "x.exr").string() + "'";
    const Outcome few = mis_with("render '" + file + "' --strategy brdf --spp 64" + out);
    EXPECT_EQ(few.exit, 0) << few.error;
    EXPECT_NE(few.error.find("not resolved"), std::string::npos) << few.error;
    const Outcome many = mis_with("render '" + file + "' --strategy uniform/light --spp 64" + out);
    EXPECT_NE(many.error.find("relative error of the estimate: "), std::string::npos);
    EXPECT_NE(many.error.find(" %"), std::string::npos) << many.error;
}

std::set<std::string> files_in(const std::filesystem::path& folder)
{
    std::set<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files.insert(entry.path().filename().string());
    return files;
}

const std::string small_run = " --resolution 24x16 --spp 8 --quiet --strategy brdf,uniform/power";

TEST(CommandLine, CompareLeavesAReportFolder)
{
    const TemporaryFolder folder;
    const std::string out = " --out '" + (folder / "report").string() + "'";
    const std::string two = "compare " + scene("single") + " " + scene("veach") + small_run + out;
    const Outcome written = mis_with(two);
    ASSERT_EQ(written.exit, 0) << written.error;
    EXPECT_EQ(files_in(folder / "report"),
              (std::set<std::string>{"maps-1.exr", "maps-2.exr", "report.html", "report.json",
                                     "strategies.csv"}));
    // Not over a report that stands, unless told so; then without what it left behind.
    const Outcome refused = mis_with("compare " + scene("single") + small_run + out);
    EXPECT_EQ(refused.exit, 2);
    EXPECT_NE(refused.error.find("--force"), std::string::npos) << refused.error;
    EXPECT_EQ(mis_with("compare " + scene("single") + small_run + out + " --force").exit, 0);
    EXPECT_EQ(files_in(folder / "report"),
              (std::set<std::string>{"maps.exr", "report.html", "report.json", "strategies.csv"}));
}

/// Files may grow to 100 kB: the figures fit, the page does not.
TEST(CommandLine, LeavesNoHalfOfAReportWhereTheDiskIsFull)
{
    const TemporaryFolder folder;
    const std::string out = (folder / "report").string(), error = (folder / "error").string();
    const int status = std::system(("trap '' XFSZ; ulimit -f 200; '" + program_file().string() +
                                    "' compare " + scene("single") + small_run + " --out '" + out +
                                    "' >/dev/null 2>'" + error + "'")
                                       .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_NE(text_of(error).find("report.html: cannot be written"), std::string::npos)
        << text_of(error);
    EXPECT_EQ(files_in(out), (std::set<std::string>{"report.json", "strategies.csv"}));
}

/// What shows how far a run is goes to terminals alone, and is wiped before the result.
TEST(CommandLine, DrawsAndWipesItsProgressOnATerminalAlone)
{
    const std::string run = "compare " + scene("single") + " --resolution 24x16 --spp 64";
    const Outcome piped = mis_with(run);
    EXPECT_EQ(piped.out.find('\x1b'), std::string::npos);
    EXPECT_EQ(piped.error.find('\x1b'), std::string::npos);
    const TemporaryFolder folder;
    const std::string out = (folder / "out").string();
    ASSERT_EQ(std::system(("script -qec \"'" + program_file().string() + "' " + run +
                           "\" /dev/null >'" + out + "' </dev/null")
                              .c_str()),
              0);
    const std::string shown = text_of(out);
    const std::size_t wiped = shown.rfind("\x1b[J");
    ASSERT_NE(wiped, std::string::npos);
    EXPECT_LT(shown.find("[.."), wiped);  // the bar
    EXPECT_EQ(shown.find("[..", wiped), std::string::npos);
    EXPECT_NE(shown.find("rank  strategy", wiped), std::string::npos);
}

/// What stands in place of lists that are not given, where there are no more than 32 lights.
std::vector<std::string> default_list(bool has_lobes)
{
    std::vector<std::string> policies{"uniform", "power", "solid-angle", "radiant-solid-angle",
                                      "all"};
    if (has_lobes) policies.emplace_back("irradiance");
    policies.emplace_back("product");
    std::vector<std::string> names;
    for (const std::string& policy : policies)
        for (const char* heuristic : {"light", "balance", "power"})
            names.push_back(policy + "/" + heuristic);
    for (const char* name : {"all/light/union", "product/light/projected", "brdf"})
        names.emplace_back(name);
    return names;
}

std::vector<std::string> strategies_of(const nlohmann::json& scene)
{
    std::vector<std::string> names;
    for (const auto& strategy : scene.at("strategies")) names.push_back(strategy.at("name"));
    return names;
}

TEST(Compare, RanksItsDefaultListWhereNothingIsNamed)
{
    const Outcome run = mis_with("compare '" + scene("veach") + "' '" + scene("single") + "' '" +
                                 scene("veach-blinn") + "' --resolution 8x6 --spp 4 --json -");
    ASSERT_EQ(run.exit, 0) << run.error;
    const auto json = nlohmann::json::parse(run.out);
    ASSERT_EQ(json.at("scenes").size(), 3U);
    EXPECT_EQ(strategies_of(json.at("scenes")[0]), default_list(true));
    EXPECT_EQ(strategies_of(json.at("scenes")[1]), default_list(false));
    const std::size_t lobes = run.error.find(
                          "left out: not ranked by default here; add "
                          "--policy tree\n"),
                      none = run.error.find("add --policy irradiance,tree\n");
    ASSERT_NE(lobes, run.error.npos) << run.error;
    EXPECT_NE(none, run.error.npos);
    EXPECT_EQ(run.error.find("--policy tree", lobes + 60), run.error.npos) << "once a run";
}

TEST(Compare, RanksNoMoreThanTheListsThatAreNamed)
{
    const Outcome run = mis_with("compare '" + scene("single") + "' --resolution 8x6 --spp 4 " +
                                 "--policy product --heuristic light --quiet --json -");
    ASSERT_EQ(run.exit, 0) << run.error;
    EXPECT_EQ(strategies_of(nlohmann::json::parse(run.out).at("scenes")[0]),
              std::vector<std::string>{"product/light"});
    const Outcome one = mis_with("compare '" + scene("single") + "' --resolution 8x6 --spp 4 " +
                                 "--policy product --quiet --json -");
    EXPECT_EQ(
        strategies_of(nlohmann::json::parse(one.out).at("scenes")[0]),
        (std::vector<std::string>{"product/light", "product/balance", "product/power", "brdf"}));
}

TEST(Compare, RanksStrataOfAsManyDrawsAsTheEfficiencyIsForWhereItCan)
{
    const std::string small = "compare '" + scene("single") + "' --resolution 8x6 --quiet --json -";
    const auto names = [&](const std::string& options) {
        return strategies_of(nlohmann::json::parse(mis_with(small + options).out).at("scenes")[0]);
    };
    EXPECT_EQ(names(" --spp 64").back(), "strata@16");
    EXPECT_EQ(names(" --spp 64 --at 8").back(), "strata@8");
    EXPECT_EQ(names(" --spp 63").back(), "brdf");  // not four times 16
    EXPECT_EQ(names(" --spp 64 --strategy strata,strata@4"),
              (std::vector<std::string>{"strata@16", "strata@4"}));
}

TEST(Compare, RefusesStrataOfMoreLightsThanItKeepsFiguresOf)
{
    const TemporaryFolder folder;
    auto json = nlohmann::json::parse(text_of(scene("single")), nullptr, true, true);  // comments
    const auto light = json.at("lights").at(0);
    while (json.at("lights").size() < 1025) {
        auto next = light;
        next["center"][0] = 10.0 + double(json.at("lights").size());
        json["lights"].push_back(next);
    }
    const std::string file = (folder / "many.json").string();
    std::ofstream(file) << json.dump();
    const Outcome run = mis_with("render '" + file + "' --strategy strata --spp 4 --out '" +
                                 (folder / "a.exr").string() + "'");
    EXPECT_EQ(run.exit, 2);
    EXPECT_NE(run.error.find("1025 lights; at most 1024"), run.error.npos) << run.error;
    const Outcome ranked = mis_with("compare '" + file + "' --resolution 4x4 --spp 64 --json -");
    EXPECT_EQ(ranked.exit, 0) << ranked.error;
    EXPECT_NE(ranked.error.find("left out: strata@16: "), ranked.error.npos) << ranked.error;
}

/// Mean and variance of every strategy of a report, to the last digit that is written.
std::string figures_of(const std::string& report)
{
    std::string figures;
    const auto json = nlohmann::json::parse(report);
    for (const auto& strategy : json.at("scenes").at(0).at("strategies"))
        figures += strategy.at("name").dump() + strategy.at("mean").dump() +
                   strategy.at("variance").dump() + strategy.at("invalid_samples").dump() + "\n";
    return figures;
}

TEST(Effects, LeftOutChangeNoDigitOnAnyShippedScene)
{
    int scenes = 0;
    for (const auto& file : std::filesystem::directory_iterator(source_dir() / "scenes")) {
        if (file.path().extension() != ".json") continue;
        const std::string words =
            "compare '" + file.path().string() +
            "' --resolution 24x16 --spp 32 --quiet --json - --strategy "
            "uniform/power,solid-angle/light,all/balance,radiant-solid-angle/maximum/union,brdf,"
            "strata@8";
        const Outcome all = mis_with(words + " --effects all"), leaner = mis_with(words);
        ASSERT_EQ(all.exit, 0) << all.error;
        ASSERT_EQ(leaner.exit, 0) << leaner.error;
        EXPECT_EQ(figures_of(all.out), figures_of(leaner.out)) << file.path();
        ++scenes;
    }
    EXPECT_GE(scenes, 10);
}

}  // namespace
}  // namespace mis
