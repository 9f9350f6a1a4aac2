#include "mis/io/integral_report.h"

#include "mis/io/json_parts.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace mis {
namespace {

std::string field(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

double share_below_horizon(const HemisphereRun& run)
{
    return static_cast<double>(run.below_horizon) / static_cast<double>(run.values.count);
}

OrderedJson exponent(const HemisphereEstimator& estimator)
{
    return estimator.density == HemisphereDensity::blinn ? OrderedJson(estimator.exponent)
                                                         : OrderedJson(nullptr);
}

OrderedJson exactly(const HemisphereEstimator& estimator)
{
    const ExactHemisphere e = exact(estimator);
    return {{"mean", json_figure(e.mean)},
            {"variance", json_figure(e.variance)},
            {"log10_variance", json_figure(e.log10_variance)},
            {"largest_value", json_figure(e.largest_value)},
            {"log10_largest_value", json_figure(e.log10_largest_value)},
            {"below_horizon", json_figure(e.below_horizon)}};
}

OrderedJson measured(const HemisphereRun& run, double integral)
{
    return {{"samples", run.values.count},
            {"mean", json_figure(run.values.mean)},
            {"mean_se", json_figure(run.values.mean_se())},
            {"error", json_figure(run.values.mean - integral)},
            {"variance", json_figure(run.values.variance())},
            {"variance_se", json_figure(run.values.variance_se())},
            {"below_horizon", share_below_horizon(run)}};
}

OrderedJson density(const IntegralReport::Entry& entry)
{
    const HemisphereDensityText& text = text_of(entry.estimator.density);
    OrderedJson json{{"name", text.name},
                     {"draws", text.draws},
                     {"pdf", text.pdf},
                     {"exponent", exponent(entry.estimator)},
                     {"finite_variance", std::isfinite(exact(entry.estimator).log10_largest_value)},
                     {"exact", exactly(entry.estimator)}};
    const std::uint64_t drawn = entry.running.empty() ? 0 : entry.running.back().values.count;
    const Unseen hidden = unseen(entry.estimator, drawn);
    json["unseen"] = {{"of_integral", hidden.of_integral},
                      {"of_second_moment", hidden.of_second_moment}};
    json["running"] = OrderedJson::array();
    for (const HemisphereRun& run : entry.running)
        json["running"].push_back(measured(run, hemisphere_integral));
    return json;
}

}  // namespace

std::string integral_json(const IntegralReport& report)
{
    OrderedJson json{{"format", "mis-integrate/1"},    {"version", report.version},
                     {"command", report.command},      {"seed", report.seed},
                     {"partial", report.partial},      {"samples", report.samples},
                     {"integral", hemisphere_integral}};
    json["densities"] = OrderedJson::array();
    for (const IntegralReport::Entry& entry : report.densities)
        json["densities"].push_back(density(entry));
    return json_text(json);
}

std::string integral_csv(const IntegralReport& report)
{
    std::string text =
        "density,exponent,samples,mean,mean_se,error,variance,variance_se,below_horizon,"
        "exact_mean,exact_variance,exact_log10_variance,exact_below_horizon\r\n";
    for (const IntegralReport::Entry& entry : report.densities) {
        const HemisphereEstimator& estimator = entry.estimator;
        const ExactHemisphere e = exact(estimator);
        const bool has_exponent = estimator.density == HemisphereDensity::blinn;
        for (const HemisphereRun& run : entry.running) {
            const Moments& values = run.values;
            text += fmt::format(
                "{},{},{},{},{},{},{},{},{},{},{},{},{}\r\n", text_of(estimator.density).name,
                has_exponent ? field(estimator.exponent) : "", values.count, field(values.mean),
                field(values.mean_se()), field(values.mean - hemisphere_integral),
                field(values.variance()), field(values.variance_se()),
                field(share_below_horizon(run)), field(e.mean), field(e.variance),
                field(e.log10_variance), field(e.below_horizon));
        }
    }
    return text;
}

}  // namespace mis
