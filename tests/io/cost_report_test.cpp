#include "mis/io/cost_json.h"
#include "mis/io/cost_text.h"
#include "mis/io/text_layout.h"

#include "mis/cost/crossings.h"
#include "tests/cost/synthetic_cost.h"
#include "tests/io/schema_check.h"
#include "tests/support/places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace mis {
namespace {

using Json = nlohmann::json;

/// Curves in every state: fitted, crossing another, biased, of rare samples, not run.
CostReport sample_costs()
{
    const CostGround ground{.points = 1000, .threads = 2, .reference = {1e-6, 1e-8, 1e-6}};
    std::vector<CostMeasurements> curves{
        measured({.variance = 0.2, .reference = 1e-6}),
        measured({.name = "radiant-solid-angle/power",
                  .variance = 0.1,
                  .reference = 1e-6,
                  .prepare = 2e-6,
                  .seed = 2}),
        measured({.name = "radiant-solid-angle/balance/union@4+1", .bias = 0.05}),
        measured({.name = "brdf", .variance = 100, .carriers = 3}),
        {.strategy = parse_strategy("all/power"), .reason = reason::NoTimeLeft{}, .levels = {}}};
    curves[0].precision = Precision::in_double;
    CostSceneReport scene{{.file = "a \"b\",c.json", .name = "bulbs \xff"}};
    scene.lights = 3, scene.width = 32, scene.height = 24, scene.shading_points = 768;
    scene.replicates = 8;
    scene.reference = {.sources = {"all/power", "power/power"}, .samples = 4000, .error = 1e-3};
    std::vector<CostModel> models;
    for (const CostMeasurements& m : curves) {
        scene.curves.push_back(curve_report(m, ground));
        models.push_back(model_of(m, ground));
    }
    scene.crossings = find_crossings(std::span(models).first(2));
    return {{.version = "0.1.0", .command = "mis cost", .threads = 2}, {scene}};
}

Json described() { return Json::parse(std::ifstream(source_dir() / "docs/cost.schema.json")); }
Json emitted_costs() { return Json::parse(cost_json(sample_costs())); }

TEST(CostJson, IsAsItsDescriptionSays)
{
    const SchemaCheck check(described());
    EXPECT_EQ(check.first_fault(emitted_costs()), "");
    EXPECT_EQ(check.first_fault(Json::parse(cost_json({}))), "");
    Json lacking = emitted_costs(), wrong = emitted_costs();
    lacking["scenes"][0]["strategies"][0].erase("slope");
    EXPECT_EQ(check.first_fault(lacking), "/scenes/0/strategies/0: lacks \"slope\"");
    wrong["scenes"][0]["strategies"][0]["times"][0]["reach"] = "guessed";
    EXPECT_NE(check.first_fault(wrong), "");
}

TEST(CostJson, HoldsTheFiguresWithAllTheirDigits)
{
    const CostReport report = sample_costs();
    const CostSceneReport& scene = report.scenes[0];
    const Json json = emitted_costs()["scenes"][0], s = json["strategies"][0];
    EXPECT_EQ(emitted_costs()["format"], "mis-cost/1");
    EXPECT_EQ(s["name"], "power/power");
    EXPECT_EQ(s["precision"], "double");
    EXPECT_EQ(s["slope"]["value"].get<double>(), scene.curves[0].slope.value);
    EXPECT_EQ(s["points"][2]["error"]["low"].get<double>(), scene.curves[0].points[2].error.low);
    EXPECT_EQ(s["times"][3]["error"], 0.01);
    EXPECT_EQ(s["times"][3]["seconds"]["value"].get<double>(),
              scene.curves[0].times[3].seconds.value);
    EXPECT_EQ(s["times"][3]["reach"], "extrapolated");
    EXPECT_EQ(s["times"][0]["reach"], "measured");
    EXPECT_EQ(json["strategies"][2]["fits"], false);
    EXPECT_EQ(json["strategies"][3]["points"][0]["trust"], "rare_samples");
    EXPECT_EQ(json["strategies"][4]["status"], "not_run");
    EXPECT_TRUE(json["strategies"][4]["slope"]["value"].is_null());
    ASSERT_EQ(json["crossings"].size(), 1U);
    EXPECT_EQ(json["crossings"][0]["before"]["name"], "power/power");
    EXPECT_EQ(json["crossings"][0]["after"]["name"], "radiant-solid-angle/power");
}

TEST(CostCsv, HasAsManyFieldsInEveryRow)
{
    CostReport report = sample_costs();
    report.scenes[0].file = "plain.json";  // no comma in a field
    std::istringstream lines(cost_csv(report));
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line); ++rows) {
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 22) << line;
        EXPECT_EQ(line.back(), '\r');
    }
    EXPECT_EQ(rows, 1U + 4 * (7 + 5) + 1);
    EXPECT_NE(cost_csv(report).find(",brdf,float,point,1,"), std::string::npos);
    EXPECT_NE(cost_csv(report).find(",power/power,double,time_to,"), std::string::npos);
    EXPECT_NE(cost_csv(sample_costs()).find("\"a \"\"b\"\",c.json\""), std::string::npos);
}

TEST(CostText, FitsEightyColumnsAndMarksWhatIsNotMeasured)
{
    const std::string text = cost_text(sample_costs().scenes[0], 2);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(width_of(line), 80U) << line;
    for (const char* part : {"power/power in double beats radiant-solid-angle/power below", "-0.5",
                             "s* ", "all/power was not run (--verbose says why)", "~",
                             "In time the error of radiant-solid-angle/power falls with slope",
                             "* extrapolated", "~ few samples carry it", "- not known",
                             "4000 samples per point of all/power, pooled", "on 2 threads"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    const std::string verbose = cost_text(sample_costs().scenes[0], 2, {.is_verbose = true});
    for (const char* part :
         {"all/power has no curve: past the budget", "nothing of it is extrapolated"})
        EXPECT_NE(verbose.find(part), std::string::npos) << part << "\n" << verbose;
}

TEST(CostText, ShowsTheGainOfSobolSequences)
{
    CostReport report = sample_costs();
    report.is_sobol = report.scenes[0].is_sobol = true;
    std::vector<CostPoint>& points = report.scenes[0].curves[0].points;
    for (CostPoint& point : points)
        point.gain = {7.5 * double(point.samples), 7.4 * double(point.samples),
                      7.6 * double(point.samples)};
    const std::string text = cost_text(report.scenes[0], 2);
    EXPECT_NE(text.find("Sobol' sequence"), std::string::npos) << text;
    EXPECT_NE(text.find("gain over independent"), std::string::npos) << text;
    EXPECT_NE(text.find("30.0±0.4"), std::string::npos) << text;  // at 4
    EXPECT_EQ(cost_text(sample_costs().scenes[0], 2).find("gain"), std::string::npos);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(width_of(line), 80U) << line;
    const Json json = Json::parse(cost_json(report));
    EXPECT_EQ(SchemaCheck(described()).first_fault(json), "");
    EXPECT_EQ(json["sampler"], "sobol");
    EXPECT_EQ(json["scenes"][0]["strategies"][0]["points"][2]["gain"]["value"], 30);
    EXPECT_EQ(emitted_costs()["sampler"], "independent");
    EXPECT_TRUE(
        emitted_costs()["scenes"][0]["strategies"][0]["points"][2]["gain"]["low"].is_null());
    EXPECT_NE(cost_csv(report).find(",30,29.6,30.4\r"), std::string::npos) << cost_csv(report);
}

TEST(CostText, SaysWhichReferenceIsExact)
{
    CostSceneReport scene;
    scene.reference = {.exact = true, .sources = {}, .error = 1e-9};
    EXPECT_NE(cost_text(scene, 1).find("exact, by quadrature"), std::string::npos);
}

}  // namespace
}  // namespace mis
