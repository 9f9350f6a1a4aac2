#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <array>

namespace mis {
namespace {

struct Wrong {
    const char *words, *message;  ///< all that standard error holds, or its first line
};

TEST(Usage, IsAnsweredByOneMessageThatNamesWhatWasFoundAndWhatIsAllowed)
{
    const std::array lines{
        Wrong{"", "found no command; mis help lists them, mis help COMMAND explains one"},
        Wrong{"--sed",
              "found option \"--sed\"; known are compare, cost, render, explain, integrate, "
              "predict, replay, help, --help, --version"},
        Wrong{"explain", "explain: found no SCENE; it needs SCENE (scene file)"},
        Wrong{"compare s.json --seed",
              "--seed: found no value; it takes one: --seed N (seed of the random numbers)"},
        Wrong{"compare --seed --quiet s.json",
              "--seed: found no value before --quiet; it takes one: --seed N (seed of the random "
              "numbers)"},
        Wrong{"compare s.json --seed=", "--seed: found no value after \"=\""},
        Wrong{"compare s.json --spp 1 --spp=2",
              "--spp: found twice, with \"1\" and \"2\"; give it once"},
        Wrong{"compare s.json --quiet=3", "--quiet: found the value \"3\"; it takes none"},
        Wrong{"cost a.json b.json", "cost: found \"b.json\" after \"a.json\"; it takes one SCENE"},
        Wrong{"integrate x", "integrate: found \"x\"; it takes options alone"},
        Wrong{"integrate -m 3",
              "integrate: found option \"-m\"; known are --help, --pdf, --exponent, -n, --seed, "
              "--json, --csv"},
        Wrong{"integrate -n", "-n: found no value; it takes one: -n N (draws, from 1 to 1e9)"},
        Wrong{"explain s.json --seed 1.5",
              "--seed: found \"1.5\"; a seed is a whole number from 0 to 18446744073709551615"},
        Wrong{"explain s.json --threads 5000",
              "--threads: found \"5000\"; a number of threads is a whole number from 0 to 1024"},
        Wrong{"compare s.json --error abc", "--error: found \"abc\"; a number is needed"},
        Wrong{"compare s.json --at 1e", "--at: found \"1e\"; a number is needed"},
        Wrong{"compare a.json b.json --fail-on-regression 5%",
              "--fail-on-regression: found \"5%\"; a number is needed"},
        Wrong{"cost s.json --time 2x",
              "--time: found \"2x\"; a time is a number of seconds, or has a unit: ms, s, m or h, "
              "as in 90, 500ms, 90s, 2m and 1.5h"},
        Wrong{"render s.json --out a.exr --time 0h",
              "--time: found 0 s; a time is greater than 0 and at most 1e7 s"},
        Wrong{"help frob",
              "found command \"frob\"; known are compare, cost, render, explain, integrate, "
              "predict, replay, help, --help, --version"},
        Wrong{"help compare cost", "help: found \"cost\" after \"compare\"; it takes one command"},
        Wrong{
            "replay s.json --strategy brdf",
            "replay: found no --sample; it needs --sample N (number of the sample at that point)"},
        Wrong{"replay s.json --strategy brdf --sample 1",
              "--point and --pixel: found neither; give one of them"},
        Wrong{"replay s.json --strategy brdf --sample 1 --pixel 1,2 --point 3",
              "--point and --pixel: found both; give one of them"},
        Wrong{"compare s.json --force",
              "--force: found without --out DIR, the folder that it is for"},
        Wrong{"replay s.json --strategy brdf --sample 1 --pixel 1x2",
              "--pixel: found \"1x2\"; a pixel is its column and row, as in 12,7"},
    };
    for (const Wrong& line : lines) {
        const Outcome outcome = mis_with(line.words);
        EXPECT_EQ(outcome.exit, 2) << line.words;
        EXPECT_EQ(outcome.out, "") << line.words;
        EXPECT_EQ(outcome.error, "mis: " + std::string(line.message) + "\n") << line.words;
    }
}

TEST(Usage, OffersNoNameThatIsFar)
{
    for (const char* words : {"predict s.json --seed 1", "explain s.json --strategy brdf",
                              "integrate --spp 3", "explain s.json --technique cone"})
        EXPECT_EQ(mis_with(words).error.find("Did you mean"), std::string::npos) << words;
}

TEST(Usage, HelpIsTheSameHoweverItIsAskedFor)
{
    const std::string all = mis_with("--help").out;
    EXPECT_NE(all.find("Usage: mis [OPTIONS] COMMAND"), std::string::npos) << all;
    for (const char* words : {"help", "-h", "help help", "help --help", "--help compare"}) {
        EXPECT_EQ(mis_with(words).out, all) << words;
        EXPECT_EQ(mis_with(words).exit, 0) << words;
    }
    for (const std::string command :
         {"compare", "cost", "render", "explain", "integrate", "predict", "replay"}) {
        const Outcome help = mis_with("help " + command);
        EXPECT_EQ(help.exit, 0);
        EXPECT_NE(help.out.find("Usage: mis " + command), std::string::npos) << help.out;
        for (const char* asked : {" --help", " -h", " --quiet --no-such --help"})
            EXPECT_EQ(mis_with(command + asked).out, help.out) << command << asked;
    }
}

/// What is too long is answered in seconds.
TEST(Usage, DurationsHaveTheUnitsThatPeopleWrite)
{
    struct Duration {
        const char *text, *seconds;
    };
    for (const auto& [text, seconds] : {Duration{"3e7", "30000000"},
                                        {"3e7s", "30000000"},
                                        {"5e5m", "30000000"},
                                        {"5e5min", "30000000"},
                                        {"1e4h", "36000000"},
                                        {"3e10ms", "30000000"}})
        EXPECT_EQ(mis_with(std::string("cost s.json --time ") + text).error,
                  "mis: --time: found " + std::string(seconds) +
                      " s; a time is greater than 0 and at most 1e7 s\n")
            << text;
    for (const char* text : {"s", "'2 m'", "2d", "2mm", "1h30", "m2", "0x10", "1,5s", "2M"})
        EXPECT_NE(mis_with(std::string("cost s.json --time ") + text).error.find("has a unit: ms"),
                  std::string::npos)
            << text;
}

TEST(CommandLine, TakesADurationWithItsUnit)
{
    const Outcome run = mis_with("cost '" + scene("single") +
                                 "' --resolution 16x12 --strategy brdf --time 250ms --quiet");
    EXPECT_EQ(run.exit, 0) << run.error;
    EXPECT_NE(run.out.find("slope"), std::string::npos) << run.out;
}

TEST(CommandLine, ReplaysThePointOfAPixel)
{
    const std::string run =
        "replay '" + scene("veach") + "' --resolution 64x43 --strategy uniform/power --sample 3 ";
    const Outcome by_pixel = mis_with(run + "--pixel 12,20"),
                  by_point = mis_with(run + "--point " + std::to_string(20 * 64 + 12));
    EXPECT_EQ(by_pixel.exit, 0) << by_pixel.error;
    EXPECT_EQ(by_pixel.out, by_point.out);
    const Outcome outside = mis_with(run + "--pixel 64,0");
    EXPECT_EQ(outside.exit, 2);
    EXPECT_NE(outside.error.find("--pixel: found 64,0; the picture is 64x43, so pixels go from 0,0 "
                                 "to 63,42"),
              std::string::npos)
        << outside.error;
}

TEST(CommandLine, SaysWhereAPixelShowsNoSurface)
{
    const TemporaryFolder folder;
    const std::string file = folder
                                 .write("sky.json", R"({"format": "mis-scene/1",
        "materials": {"m": {"type": "lambert", "albedo": 0.5}},
        "camera": {"position": [0, 2, 4], "target": [0, 2, 0], "resolution": [24, 16]},
        "surfaces": [{"type": "quad", "corner": [-4, 0, 4], "edges": [[8, 0, 0], [0, 0, -8]], "material": "m"}],
        "lights": [{"center": [0, 2, 0], "radius": 0.05, "radiance": 1}]})")
                                 .string();
    const std::string run = "replay '" + file + "' --strategy brdf --sample 3 --pixel ";
    EXPECT_EQ(mis_with(run + "12,15").exit, 0);
    const Outcome sky = mis_with(run + "12,0");
    EXPECT_EQ(sky.exit, 2) << sky.out;
    EXPECT_NE(sky.error.find("--pixel: found 12,0, where"), std::string::npos) << sky.error;
}

}  // namespace
}  // namespace mis
