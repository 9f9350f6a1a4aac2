#include "mis/io/integral_report.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <numbers>

namespace mis {
namespace {

IntegralReport sample_integral()
{
    IntegralReport report{.version = "0.1.0",
                          .command = "mis integrate \xff",
                          .seed = 7,
                          .samples = 2,
                          .densities = {}};
    for (const HemisphereDensity density : hemisphere_densities) {
        IntegralReport::Entry entry{.estimator = {density, 1e5}, .running = {}};
        HemisphereRun run{.estimator = entry.estimator, .seed = 7};
        for (const std::uint64_t count : {1, 2})
            run.advance_to(count), entry.running.push_back(run);
        report.densities.push_back(entry);
    }
    return report;
}

TEST(IntegralReport, JsonHasTheOuterShapeOfReports)
{
    const auto json = nlohmann::json::parse(integral_json(sample_integral()));
    EXPECT_EQ(json["format"], "mis-integrate/1");
    for (const char* key : {"version", "command", "seed", "partial"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["integral"], std::numbers::pi);
    ASSERT_EQ(json["densities"].size(), hemisphere_densities.size());
}

TEST(IntegralReport, JsonHoldsTheFiguresAndNullForWhatADoubleCannotHold)
{
    const IntegralReport report = sample_integral();
    const auto json = nlohmann::json::parse(integral_json(report));
    const auto& uniform = json["densities"][0];
    EXPECT_EQ(uniform["running"][1]["mean"], report.densities[0].running[1].values.mean);
    EXPECT_TRUE(uniform["running"][0]["mean_se"].is_null());  // one draw tells nothing of it
    EXPECT_TRUE(uniform["exponent"].is_null());
    const auto& blinn = json["densities"].back();
    EXPECT_TRUE(blinn["exact"]["variance"].is_null());
    EXPECT_GT(blinn["exact"]["log10_variance"], 15'000);
    EXPECT_EQ(blinn["finite_variance"], true);
    EXPECT_EQ(blinn["exponent"], 1e5);
}

TEST(IntegralReport, CsvHasOneRowForEachDensityAndNumberOfDraws)
{
    const std::string csv = integral_csv(sample_integral());
    const auto lines = std::count(csv.begin(), csv.end(), '\n'),
               commas = std::count(csv.begin(), csv.end(), ',');
    EXPECT_EQ(lines, 1 + 2 * static_cast<long>(hemisphere_densities.size()));
    EXPECT_EQ(commas, lines * std::count(csv.begin(),
                                         csv.begin() + static_cast<long>(csv.find('\r')), ','));
    for (const char* nothing : {"nan", "inf"}) EXPECT_EQ(csv.find(nothing), std::string::npos);
}

TEST(IntegralReport, WhatWasInterruptedBeforeItsFirstDrawIsThereWithoutFigures)
{
    IntegralReport report = sample_integral();
    report.partial = true;
    report.densities.back().running.clear();
    const auto json = nlohmann::json::parse(integral_json(report));
    EXPECT_EQ(json["partial"], true);
    EXPECT_EQ(json["densities"].back()["running"].size(), 0u);
}

}  // namespace
}  // namespace mis
