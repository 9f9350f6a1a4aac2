#include "mis/io/predict_json.h"

#include "mis/io/csv_field.h"
#include "mis/io/json_parts.h"
#include "mis/io/text_layout.h"
#include "mis/words/predict_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mis {

namespace {

struct Figure {
    const char* name;
    double Predicted::*value;
    double Predicted::*error;
};
constexpr std::array figures{Figure{"mean", &Predicted::mean, &Predicted::mean_error},
                             Figure{"variance", &Predicted::variance, &Predicted::variance_error},
                             Figure{"fourth", &Predicted::fourth, &Predicted::fourth_error}};

OrderedJson probe_json(const PredictReport::Probe& probe, std::size_t strategy)
{
    OrderedJson json;
    for (const auto& [name, value, error] : figures) {
        if (!probe.refusal.empty()) json[name] = {{"value", nullptr}, {"error", nullptr}};
        else
            json[name] = {{"value", json_figure(probe.figures[strategy].*value)},
                          {"error", json_figure(probe.figures[strategy].*error)}};
    }
    json["refusal"] = json_text_or_null(probe.refusal);
    return json;
}

OrderedJson strategy_json(const PredictReport::Scene& scene, std::size_t i)
{
    const Strategy& s = scene.strategies[i];
    OrderedJson json = json_identity(s);
    json["probes"] = OrderedJson::array();
    for (const PredictReport::Probe& probe : scene.probes)
        json["probes"].push_back(probe_json(probe, i));
    return json;
}

PredictedVariances variances_of(const PredictReport::Scene& scene)
{
    PredictedVariances found;
    found.all_probes = scene.probes.size();
    for (const Strategy& strategy : scene.strategies) found.strategies.push_back(name_of(strategy));
    for (std::size_t p = 0; p < scene.probes.size(); ++p) {
        if (!scene.probes[p].refusal.empty()) continue;
        PredictedVariances::AtProbe& probe = found.probes.emplace_back();
        probe.number = p;
        for (const Predicted& f : scene.probes[p].figures) {
            probe.means.push_back(f.mean);
            const bool is_finite = std::isfinite(f.variance);
            probe.variances.push_back(
                {f.variance, is_finite ? std::max(0.0, f.variance - f.variance_error) : f.variance,
                 f.variance + f.variance_error});
        }
    }
    return found;
}

/// Ten places at most.
std::string shown(double value)
{
    return std::isfinite(value) ? fmt::format("{:.7g}", value) : "infinite";
}
std::string shown_error(double error)
{
    return std::isfinite(error) ? fmt::format("±{:.1e}", error) : "";
}

}  // namespace

std::string predict_json(const PredictReport& report)
{
    OrderedJson json{
        {"format", "mis-predict/1"},
        {"version", report.version},
        {"command", report.command},
        {"threads", report.threads},
        {"partial", report.partial},
        {"tolerance", {{"smooth", report.tolerance.smooth}, {"jumps", report.tolerance.jumps}}},
        {"scenes", OrderedJson::array()}};
    for (const PredictReport::Scene& scene : report.scenes) {
        OrderedJson strategies = OrderedJson::array();
        for (std::size_t i = 0; i < scene.strategies.size(); ++i)
            strategies.push_back(strategy_json(scene, i));
        json["scenes"].push_back({{"file", scene.file},
                                  {"name", scene.name},
                                  {"lights", scene.lights},
                                  {"strategies", strategies},
                                  {"sentences", sentences_of(variances_of(scene))}});
    }
    return json_text(json);
}

std::string predict_csv(const PredictReport& report)
{
    std::string csv = "scene,file,probe,strategy";
    for (const Figure& figure : figures) csv += fmt::format(",{0},{0}_error", figure.name);
    csv += ",refusal\r\n";
    for (const PredictReport::Scene& scene : report.scenes)
        for (std::size_t p = 0; p < scene.probes.size(); ++p)
            for (std::size_t i = 0; i < scene.strategies.size(); ++i) {
                const PredictReport::Probe& probe = scene.probes[p];
                csv += fmt::format("{},{},{},{}", csv_field(scene.name), csv_field(scene.file), p,
                                   csv_field(name_of(scene.strategies[i])));
                for (const auto& [name, value, error] : figures)
                    csv += probe.refusal.empty() ? "," + csv_field(probe.figures[i].*value) + "," +
                                                       csv_field(probe.figures[i].*error)
                                                 : std::string(",,");
                csv += "," + csv_field(probe.refusal) + "\r\n";
            }
    return csv;
}

std::string predict_text(const PredictReport::Scene& scene, const TextLook& look)
{
    TextTable table({{"probe", "strategy", "mean", "error", "variance", "error"}}, {3, 5, 2});
    for (std::size_t p = 0; p < scene.probes.size(); ++p) {
        const PredictReport::Probe& probe = scene.probes[p];
        if (!probe.refusal.empty()) {
            table.add_remark(fmt::format("{}", p), "-", "none: see below");
            continue;
        }
        for (std::size_t i = 0; i < scene.strategies.size(); ++i) {
            const Predicted& f = probe.figures[i];
            table.add({fmt::format("{}", p), name_of(scene.strategies[i]), shown(f.mean),
                       shown_error(f.mean_error), shown(f.variance),
                       shown_error(f.variance_error)});
        }
    }
    std::string text = table.text(look);
    for (std::size_t p = 0; p < scene.probes.size(); ++p)
        if (!scene.probes[p].refusal.empty())
            text += fitted(fmt::format("probe {}: {}\n", p, scene.probes[p].refusal), look.columns);
    const std::vector<std::string> answer = sentences_of(variances_of(scene));
    if (!answer.empty()) text += "\n";
    for (const std::string& sentence : answer)
        text += paragraph(sentence, look, &sentence == &answer[0] ? Style::answer : Style::plain);
    return text;
}

}  // namespace mis
