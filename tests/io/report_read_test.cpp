#include "mis/io/report_read.h"

#include "mis/io/report_json.h"
#include "mis/io/report_peek.h"
#include "mis/io/scene_error.h"
#include "tests/io/sample_report.h"
#include "tests/io/temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace mis {
namespace {

using Json = nlohmann::json;

/// A report's JSON as data, without its sentences: these are made anew from the figures.
Json figures_of(const Report& report)
{
    Json json = Json::parse(report_json(report));
    json.erase("sentences");
    for (Json& scene : json["scenes"]) scene.erase("sentences");
    return json;
}

Json sample() { return Json::parse(report_json(sample_report())); }

/// The message about a report that was changed at one place; "" if it is read.
std::string message_about(const char* pointer, const Json& value)
{
    Json json = sample();
    json[Json::json_pointer(pointer)] = value;
    try {
        parse_report(json.dump(), "old.json");
    } catch (const SceneError& error) {
        return error.what();
    }
    return "";
}

TEST(ReportRead, IsWhatWasWritten)
{
    const Report report = sample_report();
    EXPECT_EQ(figures_of(parse_report(report_json(report), "x")), figures_of(report));
    const Report empty = parse_report(report_json({}), "x");
    EXPECT_EQ(figures_of(empty), figures_of({}));
    EXPECT_EQ(report.scenes[0].strategies[0].timed_rounds, 16);
}

TEST(ReportRead, TakesNullForNotKnown)
{
    Json json = sample();
    json["scenes"][0]["strategies"][0]["variance"] = {
        {"value", nullptr}, {"low", nullptr}, {"high", nullptr}};
    const Report report = parse_report(json.dump(), "x");
    EXPECT_TRUE(std::isnan(report.scenes[0].strategies[0].variance.high));
    EXPECT_EQ(report.scenes[0].strategies[5].rank, 0);
}

TEST(ReportRead, PassesOverWhatLaterVersionsMayAdd)
{
    Json json = sample();
    json["new"] = {1, 2};
    json["scenes"][0]["strategies"][0]["variance"]["new"] = "x";
    json["scenes"][0]["strategies"][0]["policy"] = "later";
    json["scenes"][0]["strategies"][0]["name"] = "later/power";
    for (Json& p : json["scenes"][0]["pairs"])
        for (const char* key : {"a", "b"})
            if (p[key] == "solid-angle/power") p[key] = "later/power";
    json["scenes"][0]["strategies"][1].erase("timed_rounds");  // and what earlier ones lacked
    const Report report = parse_report(json.dump(), "x");
    EXPECT_EQ(name_of(report.scenes[0].strategies[0].strategy), "later/power");
    EXPECT_EQ(report.scenes[0].strategies[1].timed_rounds, 0);
}

TEST(ReportRead, SaysWhereWhatIsWrong)
{
    struct Wrong {
        const char* pointer;
        Json value;
        const char* message;
    };
    const std::string strategy = "/scenes/0/strategies/0/";
    for (const Wrong& wrong : std::initializer_list<Wrong>{
             {"/format", "mis-report/2", "found \"mis-report/2\"; this version reads"},
             {"/seed", -1, "found -1; a whole number between 0 and"},
             {"/seed", 1e300, "a whole number between"},
             {"/threads", 0, "a whole number between 1 and"},
             {"/threads", 1e10, "a whole number between 1 and"},
             {"/partial", 1, "true or false belongs here"},
             {"/scenes", 3, "an array, [ ... ], belongs here"},
             {"/scenes/0", {1}, "/scenes/0: found [1]; an object"},
             {"/scenes/0/resolution", {1}, "two whole numbers"},
             {"/scenes/0/replicates", 0.5, "a whole number"},
             {"/scenes/0/strategies/1/name", "a/b", "describe is \"radiant-solid-angle/balance\""},
             {"/scenes/0/strategies/1", sample()["scenes"][0]["strategies"][0],
              "stands in a scene once"},
             {"/scenes/0/strategies/0/status", "good",
              "known are not_run, not_resolved, biased, ranked"},
             {"/scenes/0/strategies/0/counts", {1, 1e9}, "counts/1: found 1000000000"},
             {"/scenes/0/strategies/0/mean", "x", "found \"x\"; a number, or null, belongs here"},
             {"/scenes/0/strategies/0/variance/low", -1, "found -1; a number that is at least 0"},
             {"/scenes/0/strategies/0/variance/low", 1e9, "low is at most high"},
             {"/scenes/0/strategies/0/rank", 0, "a whole number between 1"},
             {"/scenes/0/pairs/0/a", "brdf/x", "the name of a strategy of this scene"},
             {"/scenes/0/effects/shadows/on", "yes", "/scenes/0/effects/shadows/on: found"},
             {"/overall/0/beaten_by_exact", 1e18, "a whole number"},
         }) {
        const std::string message = message_about(wrong.pointer, wrong.value);
        EXPECT_NE(message.find(wrong.message), std::string::npos)
            << wrong.pointer << ": " << message;
        EXPECT_EQ(message.find("old.json: " + std::string(wrong.pointer).substr(0, 8)), 0u)
            << message;
    }
}

TEST(ReportRead, NeedsEveryKey)
{
    Json json = sample();
    json["scenes"][0]["strategies"][0].erase("variance");
    try {
        parse_report(json.dump(), "old.json");
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_STREQ(error.what(),
                     "old.json: /scenes/0/strategies/0/variance: found nothing; \"variance\" is "
                     "required here\n    See docs/report-format.md.");
    }
}

TEST(ReportRead, RefusesWhatIsTooDeepOrTooLarge)
{
    const auto refused = [](const std::string& text) {
        EXPECT_THROW(parse_report(text, "x"), SceneError) << text.substr(0, 40);
    };
    refused("{\"format\": " + std::string(100'000, '['));
    refused("{\"format\": \"mis-report/1\", \"seed\": 1e999}");
    refused("");
    refused("[]");
    refused("[[1]]");
    refused("{\"\": [1]}");
    refused("{\"format\": \"mis-report/1\"");
}

TEST(ReportFile, IsKnownByItsFormat)
{
    const TemporaryFolder folder;
    const auto is_report = [&](const std::string& text) {
        return is_report_file(folder.write("x.json", text));
    };
    EXPECT_TRUE(is_report(report_json(sample_report())));
    EXPECT_TRUE(is_report("{\"at\":16,\"format\" :\n\"mis-report/2\""));
    EXPECT_FALSE(is_report("{\"format\": \"mis-scene/1\", \"name\": \"mis-report/1\"}"));
    EXPECT_FALSE(is_report("{\"name\": \"format\"}"));
    EXPECT_FALSE(is_report("{\"format\""));
    EXPECT_FALSE(is_report(""));
    EXPECT_FALSE(is_report_file(folder / "none.json"));
    EXPECT_FALSE(is_report_file(folder / "."));
    EXPECT_FALSE(is_report(std::string(1 << 17, ' ') + report_json({})));  // not near the start
}

}  // namespace
}  // namespace mis
