#include "mis/io/predict_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace mis {
namespace {

PredictReport sample_predictions()
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Predicted figures{.mean = 0.1,
                            .mean_error = 1e-12,
                            .variance = 2.0 / 3,
                            .variance_error = 1e-9,
                            .fourth = infinity,
                            .fourth_error = infinity};
    PredictReport report{.version = "0.1.0", .command = "mis predict \xff"};
    report.scenes.push_back(
        {.file = "a,b.json",
         .name = "two \"probes\"",
         .lights = 3,
         .strategies = {parse_strategy("power/balance/union@2+3"), parse_strategy("brdf")},
         .probes = {{.figures = {figures, figures}, .refusal = ""},
                    {.figures = {}, .refusal = "surface 1 is a quad"}}});
    return report;
}

TEST(PredictJson, HasTheOuterShapeOfReports)
{
    const auto json = nlohmann::json::parse(predict_json(sample_predictions()));
    EXPECT_EQ(json["format"], "mis-predict/1");
    for (const char* key : {"version", "command", "threads", "partial", "scenes"})
        EXPECT_TRUE(json.contains(key)) << key;
    const auto& scene = json["scenes"][0];
    EXPECT_EQ(scene["file"], "a,b.json");
    EXPECT_EQ(scene["lights"], 3);
    EXPECT_EQ(scene["sentences"],
              nlohmann::json({"At probe 0 power/balance/union@2+3 and brdf have the least "
                              "variance, 0.667, equal within the bounds of error."}));
    const auto& strategy = scene["strategies"][0];
    EXPECT_EQ(strategy["name"], "power/balance/union@2+3");
    EXPECT_EQ(strategy["technique"], "union");
    EXPECT_EQ(strategy["counts"], nlohmann::json({2, 3}));
    EXPECT_TRUE(scene["strategies"][1]["policy"].is_null());
}

TEST(PredictJson, KeepsAllDigitsAndHasNullForWhatIsInfiniteOrRefused)
{
    const auto json = nlohmann::json::parse(predict_json(sample_predictions()));
    const auto& probes = json["scenes"][0]["strategies"][1]["probes"];
    ASSERT_EQ(probes.size(), 2u);
    EXPECT_EQ(probes[0]["variance"]["value"], 2.0 / 3);
    EXPECT_EQ(probes[0]["variance"]["error"], 1e-9);
    EXPECT_TRUE(probes[0]["fourth"]["value"].is_null());
    EXPECT_TRUE(probes[0]["refusal"].is_null());
    EXPECT_TRUE(probes[1]["mean"]["value"].is_null());
    EXPECT_EQ(probes[1]["refusal"], "surface 1 is a quad");
}

TEST(PredictCsv, HasOneRowForEachProbeAndStrategy)
{
    const std::string csv = predict_csv(sample_predictions());
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 2);
    EXPECT_NE(csv.find("\"two \"\"probes\"\"\",\"a,b.json\",0,brdf,0.1,1e-12,"), std::string::npos)
        << csv;
    EXPECT_NE(csv.find(",1,brdf,,,,,,,surface 1 is a quad\r\n"), std::string::npos) << csv;
}

TEST(PredictText, SaysWhyThereAreNoFigures)
{
    const std::string text = predict_text(sample_predictions().scenes[0]);
    EXPECT_NE(text.find("power/balance/union@2+3"), std::string::npos) << text;
    EXPECT_NE(text.find("0.6666667"), std::string::npos) << text;
    EXPECT_NE(text.find("probe 1: surface 1 is a quad"), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("equal within the bounds of error.\n")) << text;
}

}  // namespace
}  // namespace mis
