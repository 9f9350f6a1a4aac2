#include "mis/io/changes_json.h"

#include "mis/io/csv_field.h"
#include "tests/io/sample_report.h"
#include "tests/support/changes.h"
#include "tests/support/places.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

namespace mis {
namespace {

using Json = nlohmann::json;

Report worse_report()
{
    Report report = sample_report();
    StrategyReport& s = report.scenes[0].strategies[0];
    for (double* part : {&s.variance.value, &s.variance.low, &s.variance.high}) *part *= 1.5;
    report.scenes[0].strategies.pop_back();
    report.scenes.pop_back();
    return report;
}

Json emitted(const ChangesOptions& options = {.worse_by = 0.05})
{
    return Json::parse(changes_json(
        remarked_changes(sample_report(), worse_report(), options),
        {.version = "0.1.0", .command = "mis compare a b", .file_before = "a", .file_after = "b"}));
}

TEST(ChangesJson, HoldsEachFigureBeforeAndAfter)
{
    const Json json = emitted();
    EXPECT_EQ(json["format"], "mis-changes/1");
    EXPECT_EQ(json["file_before"], "a");
    EXPECT_EQ(json["fail_on_regression"], 5);
    EXPECT_EQ(json["regression"], true);
    EXPECT_EQ(json["changed"], 1);
    const Json s = json["scenes"][0]["strategies"][0], variance = s["variance"];
    EXPECT_EQ(s["name"], "solid-angle/power");
    EXPECT_EQ(s["status_before"], "ranked");
    EXPECT_EQ(variance["before"], sample_report().scenes[0].strategies[0].variance.value);
    EXPECT_NEAR(variance["ratio"]["value"].get<double>(), 1.5, 1e-12);
    EXPECT_LT(variance["ratio"]["low"].get<double>(), 1.5);
    EXPECT_EQ(variance["verdict"], "changed");
    EXPECT_EQ(variance["regression"], true);
    EXPECT_EQ(s["mean"]["verdict"], "~");
    EXPECT_EQ(s["mean"]["difference"]["value"], 0);
}

TEST(ChangesJson, IsNullWhereNothingIsCompared)
{
    const Json json = emitted(), strategies = json["scenes"][0]["strategies"];
    EXPECT_TRUE(strategies[6]["status_after"].is_null());
    EXPECT_TRUE(strategies[5]["variance"]["verdict"].is_null());
    EXPECT_TRUE(strategies[2]["efficiency"]["before"].is_null());  // infinite
    EXPECT_TRUE(json["scenes"][1]["file_after"].is_null());
    EXPECT_TRUE(emitted({})["regression"].is_null());
    EXPECT_TRUE(emitted({})["fail_on_regression"].is_null());
}

TEST(ChangesJson, IsExplainedKeyByKey)
{
    std::ifstream file(source_dir() / "docs/json-outputs.md");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t begin = text.find("`mis-changes/1`", text.find("## `mis compare OLD"));
    ASSERT_NE(begin, std::string::npos);
    text.erase(0, begin);
    std::set<std::string> keys;
    const auto add = [&](const Json& object) {
        for (const auto& [key, value] : object.items()) keys.insert(key);
    };
    const Json json = emitted();
    add(json), add(json["scenes"][0]), add(json["scenes"][0]["strategies"][0]);
    add(json["scenes"][0]["strategies"][0]["variance"]);
    add(json["scenes"][0]["strategies"][0]["mean"]);
    EXPECT_GT(keys.size(), 25u);
    keys.erase("format"), keys.erase("version"),
        keys.erase("command");  // said of all formats above
    for (const std::string& key : keys)
        EXPECT_NE(text.find("`" + key + "`"), std::string::npos) << key;
}

TEST(ChangesCsv, HasOneRowForEachSceneAndStrategy)
{
    const std::string text = changes_csv(remarked_changes(sample_report(), worse_report()));
    std::istringstream lines(text);
    std::string header, first;
    std::getline(lines, header), std::getline(lines, first);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 7);
    EXPECT_EQ(header.rfind("scene,file_before,file_after,strategy,", 0), 0u);
    EXPECT_NE(header.find(",variance_ratio,variance_ratio_low,"), std::string::npos);
    EXPECT_EQ(first.rfind("plates,scenes/plates.json,scenes/plates.json,solid-angle/power,", 0),
              0u);
    EXPECT_NE(first.find(",changed,false,"), std::string::npos);  // no regressions were asked for
    EXPECT_EQ(std::count(header.begin(), header.end(), ','),
              std::count(first.begin(), first.end(), ','));
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_EQ(text.find("inf"), std::string::npos);
}

TEST(CsvField, IsQuotedOnlyWhereNeeded)
{
    EXPECT_EQ(csv_field(std::string("a b")), "a b");
    EXPECT_EQ(csv_field(std::string("a, \"b\"")), "\"a, \"\"b\"\"\"");
    EXPECT_EQ(csv_field(std::string("a\nb")), "\"a\nb\"");
    EXPECT_EQ(csv_field(0.1), "0.1");
    EXPECT_EQ(csv_field(std::numeric_limits<double>::infinity()), "");
}

}  // namespace
}  // namespace mis
