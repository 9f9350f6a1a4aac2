#include "mis/io/report_json.h"

#include "tests/io/sample_report.h"
#include "tests/io/schema_check.h"
#include "tests/support/places.h"

#include <gtest/gtest.h>

#include <fstream>

namespace mis {
namespace {

using Json = nlohmann::json;

Json described_report()
{
    return Json::parse(std::ifstream(source_dir() / "docs/report.schema.json"));
}
Json emitted_report() { return Json::parse(report_json(sample_report())); }

Json strategy_named(const Json& scene, const std::string& name)
{
    for (const Json& s : scene["strategies"])
        if (s["name"] == name) return s;
    return {};
}

TEST(ReportJson, IsAsItsDescriptionSays)
{
    const SchemaCheck check(described_report());
    EXPECT_EQ(check.first_fault(emitted_report()), "");
    EXPECT_EQ(check.first_fault(Json::parse(report_json({}))), "");
    Report bare;
    bare.scenes.resize(2);
    EXPECT_EQ(check.first_fault(Json::parse(report_json(bare))), "");
}

TEST(ReportJson, IsNotAsDescribedOnceAnythingChanges)
{
    const SchemaCheck check(described_report());
    Json lacking = emitted_report(), wrong = emitted_report(), more = emitted_report(),
         null = emitted_report();
    lacking["scenes"][0]["strategies"][0].erase("rank_low");
    EXPECT_EQ(check.first_fault(lacking), "/scenes/0/strategies/0: lacks \"rank_low\"");
    wrong["scenes"][0]["strategies"][0]["status"] = "good";
    EXPECT_NE(check.first_fault(wrong), "");
    more["extra"] = 1;
    EXPECT_EQ(check.first_fault(more), ": has an unknown \"extra\"");
    null["seed"] = nullptr;
    EXPECT_NE(check.first_fault(null), "");
}

TEST(ReportJson, HoldsTheFiguresWithAllTheirDigits)
{
    const Report report = sample_report();
    const StrategyReport& first = report.scenes[0].strategies[0];
    const Json s = emitted_report()["scenes"][0]["strategies"][0];
    EXPECT_EQ(s["name"], "solid-angle/power");
    EXPECT_EQ(s["variance"]["value"].get<double>(), first.variance.value);
    EXPECT_EQ(s["variance"]["low"].get<double>(), first.variance.low);
    EXPECT_EQ(s["seconds_to_1_percent"].get<double>(), first.seconds_to_1_percent.value);
    EXPECT_EQ(s["tied_with"], Json({"radiant-solid-angle/balance"}));
    EXPECT_EQ(s["stage_seconds"]["choose"].get<double>(), first.stage_seconds.at("choose"));
    EXPECT_EQ(s["probes"].size(), 2u);
}

TEST(ReportJson, NamesStrategiesAsData)
{
    const Json scene = emitted_report()["scenes"][0];
    const Json brdf = strategy_named(scene, "brdf");
    EXPECT_TRUE(brdf["policy"].is_null());
    EXPECT_TRUE(brdf["heuristic"].is_null());
    EXPECT_EQ(brdf["counts"], Json({0, 1}));
    EXPECT_EQ(brdf["status"], "not_resolved");
    EXPECT_EQ(strategy_named(scene, "uniform/light")["counts"], Json({1, 0}));
    EXPECT_EQ(strategy_named(scene, "all/balance@4+1")["counts"], Json({4, 1}));
    EXPECT_EQ(strategy_named(scene, "power/power/one-sample")["model"], "one-sample");
}

TEST(ReportJson, IsNullWhereThereIsNoFigure)
{
    const Json scene = emitted_report()["scenes"][0];
    const Json dear = strategy_named(scene, "all/balance@4+1"),
               exact = strategy_named(scene, "uniform/light");
    EXPECT_EQ(dear["status"], "not_run");
    EXPECT_TRUE(dear["variance"]["value"].is_null());
    EXPECT_TRUE(dear["rank"].is_null());
    EXPECT_EQ(dear["estimated_seconds"], 600);
    EXPECT_EQ(exact["exact"], true);
    EXPECT_EQ(exact["variance"]["value"], 0);
    EXPECT_TRUE(exact["efficiency"]["value"].is_null());  // infinite
}

TEST(ReportJson, BeginsItsSentencesWithTheVerdict)
{
    EXPECT_EQ(
        emitted_report()["scenes"][0]["sentences"][0].get<std::string>().find("Use uniform/light"),
        0u);
}

TEST(ReportJson, SurvivesNamesThatAreNotUtf8)
{
    Report report = sample_report();
    report.scenes[0].file = "caf\xe9.json";
    EXPECT_TRUE(Json::accept(report_json(report)));
}

}  // namespace
}  // namespace mis
