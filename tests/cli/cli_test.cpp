#include "tests/io/temporary_folder.h"
#include "tests/support/places.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <string>

namespace mis {
namespace {

struct Outcome {
    int exit;
    std::string out, error;
};

std::string text_of(const std::string& file)
{
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Runs the program with these words, as a shell splits them.
Outcome mis_with(const std::string& words)
{
    const TemporaryFolder folder;
    const std::string out = (folder / "out").string(), error = (folder / "error").string();
    const int status = std::system(
        ("'" + program_file().string() + "' " + words + " >'" + out + "' 2>'" + error + "'")
            .c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(error)};
}

std::string scene(const std::string& name)
{
    return (source_dir() / "scenes" / (name + ".json")).string();
}

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
        BadLine{"compare", "scenes is required"},
        BadLine{"compare /no/such.json", "no such file"},
        BadLine{"compare .", "found a directory"},
        BadLine{"compare VEACH --policy powr", "Did you mean \"power\""},
        BadLine{"compare VEACH --heuristic balanced", "Did you mean \"balance\""},
        BadLine{"compare VEACH --strategy uniform/brdf", "say \"brdf\""},
        BadLine{"compare VEACH --strategy all/power/one-sample", "draws for every light"},
        BadLine{"compare VEACH --strategy ,", "names separated by commas"},
        BadLine{"compare VEACH --spp 0", "--spp: found 0"},
        BadLine{"compare VEACH --spp 8 --time 2", "found more than one"},
        BadLine{"compare VEACH --time -1", "--time: found -1"},
        BadLine{"compare VEACH --error 0", "--error: found 0"},
        BadLine{"compare VEACH --at 0", "--at: found 0"},
        BadLine{"compare VEACH --seed -1", "found \"-1\""},
        BadLine{"compare VEACH --threads -3", "--threads: found -3"},
        BadLine{"compare VEACH --resolution 0x4", "--resolution: found \"0x4\""},
        BadLine{"compare VEACH --resolution 99999x4", "--resolution: found"},
        BadLine{"compare VEACH --effects some", "--effects: found \"some\""},
        BadLine{"compare VEACH --sampler halton", "--sampler: found \"halton\""},
        BadLine{"compare VEACH --spp 8 --json - --csv -", "standard output takes one"},
        BadLine{"compare VEACH --spp 8 --json /no/such/folder/x.json", "there is no folder"},
        BadLine{"compare VEACH --spp 8 --out /no/such/folder/x", "there is no folder"},
        BadLine{"compare VEACH --resolution 16384x16384", "GB"},
        BadLine{"render VEACH", "--out is required"},
        BadLine{"render VEACH --out /no/such/x.exr", "there is no folder"},
        BadLine{"render VEACH --strategy brdff --out x.exr", "Did you mean \"brdf\""},
        BadLine{"cost", "scene is required"},
        BadLine{"cost VEACH --strategy powr/power", "Did you mean \"power\""},
        BadLine{"cost VEACH --precision half", "--precision: found \"half\""},
        BadLine{"cost VEACH --precision float,", "names separated by commas"},
        BadLine{"cost VEACH --spp 0", "--spp: found 0"},
        BadLine{"cost VEACH --spp 99999999", "--spp: found 99999999"},
        BadLine{"cost VEACH --spp 8 --time 2", "found more than one"},
        BadLine{"cost VEACH --time 0", "--time: found 0"},
        BadLine{"cost VEACH --error 0.1", "--error"},
        BadLine{"cost VEACH VEACH", "not expected"},
        BadLine{"cost VEACH --json - --csv -", "standard output takes one"},
        BadLine{"integrate --pdf cosin", "Did you mean \"cosine\""},
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
        EXPECT_EQ(outcome.out, "") << line.words;
    }
}

TEST(CommandLine, HelpsOnEveryCommand)
{
    for (const char* command : {"", "compare", "cost", "render", "explain", "integrate"}) {
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
                              "power/balance,all/light,brdf --json - --quiet --threads ";
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
    std::size_t files = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder / ""))
        ++files;
    EXPECT_EQ(files, 1U);
}

TEST(CommandLine, FailsWithExitCode1OnAFullDisk)
{
    const Outcome outcome = mis_with("compare '" + scene("single") +
                                     "' --resolution 8x8 --spp 4 --quiet --json /dev/full");
    EXPECT_EQ(outcome.exit, 1) << outcome.error;
    EXPECT_NE(outcome.error.find("/dev/full"), std::string::npos) << outcome.error;
}

}  // namespace
}  // namespace mis
