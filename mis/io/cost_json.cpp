#include "mis/io/cost_json.h"

#include "mis/io/csv_field.h"
#include "mis/io/json_parts.h"
#include "mis/words/cost_remarks.h"
#include "mis/words/reasons.h"

#include <fmt/format.h>

namespace mis {
namespace {

OrderedJson point_json(const CostPoint& p)
{
    return {{"samples", p.samples},
            {"error", json_interval(p.error)},
            {"seconds", json_interval(p.seconds)},
            {"trust", name_of(p.trust)},
            {"gain", json_interval(p.gain)}};
}

OrderedJson time_json(const TimeToError& t)
{
    return {{"error", t.error},
            {"samples", json_figure(t.samples)},
            {"seconds", json_interval(t.seconds)},
            {"reach", name_of(t.reach)}};
}

OrderedJson curve_json(const CostCurveReport& c)
{
    OrderedJson json = json_identity(c.strategy);
    json["precision"] = name_of(c.precision);
    json["status"] = is_none(c.reason) ? "measured" : "not_run";
    json["reason"] = json_text_or_null(reason_words(c.reason));
    json["slope"] = json_interval(c.slope);
    json["slope_p_value"] = json_figure(c.slope_p_value);
    json["slope_in_time"] = json_interval(c.slope_in_time);
    json["fits"] = c.fits;
    json["relative_variance"] = json_interval(c.relative_variance);
    json["seconds_per_point"] = json_interval(c.seconds_per_point);
    json["seconds_per_sample"] = json_interval(c.seconds_per_sample);
    json["invalid_samples"] = c.invalid_samples;
    json["points"] = OrderedJson::array();
    for (const CostPoint& p : c.points) json["points"].push_back(point_json(p));
    json["times"] = OrderedJson::array();
    for (const TimeToError& t : c.times) json["times"].push_back(time_json(t));
    return json;
}

OrderedJson crossing_json(const CrossingReport& c, const CostSceneReport& scene)
{
    const auto curve = [&](int i) {
        const CostCurveReport& found = scene.curves[static_cast<std::size_t>(i)];
        return OrderedJson{{"name", name_of(found.strategy)},
                           {"precision", name_of(found.precision)}};
    };
    return {{"before", curve(c.before)},
            {"after", curve(c.after)},
            {"seconds", json_interval(c.seconds)},
            {"error", json_interval(c.error)},
            {"extrapolated", c.is_extrapolated}};
}

OrderedJson scene_json(const CostSceneReport& s)
{
    OrderedJson json{{"file", s.file},
                     {"name", s.name},
                     {"lights", s.lights},
                     {"resolution", json_resolution(s.width, s.height)},
                     {"shading_points", s.shading_points},
                     {"replicates", s.replicates},
                     {"copies", s.copies},
                     {"epsilon", json_figure(s.epsilon)},
                     {"partial", s.partial},
                     {"seconds", json_figure(s.seconds)},
                     {"reference",
                      {{"kind", s.reference.exact ? "exact" : "pooled"},
                       {"strategies", s.reference.sources},
                       {"samples", s.reference.samples},
                       {"error", json_figure(s.reference.error)},
                       {"agrees", s.reference.agrees}}}};
    put_setup(json, s.setup);
    json["strategies"] = OrderedJson::array();
    for (const CostCurveReport& c : s.curves) json["strategies"].push_back(curve_json(c));
    json["crossings"] = OrderedJson::array();
    for (const CrossingReport& c : s.crossings) json["crossings"].push_back(crossing_json(c, s));
    json["sentences"] = sentences_of(s);
    return json;
}

std::string cells(const Interval& x)
{
    return csv_field(x.value) + "," + csv_field(x.low) + "," + csv_field(x.high);
}

/// scene, file, strategy, precision: how every row begins.
std::string identity(const CostSceneReport& scene, const CostCurveReport& c)
{
    return fmt::format("{},{},{},{},", csv_field(scene.name), csv_field(scene.file),
                       csv_field(name_of(c.strategy)), name_of(c.precision));
}

/// What every row of a curve ends with.
std::string tail(const CostCurveReport& c, const std::string& gain = ",,")
{
    return fmt::format(",{},{},{},{}\r\n", cells(c.slope), cells(c.slope_in_time),
                       csv_field(reason_words(c.reason)), gain);
}

std::string rows(const CostSceneReport& scene, const CostCurveReport& c)
{
    if (c.points.empty()) return identity(scene, c) + "none,,,,,,,," + tail(c);
    std::string text;
    for (const CostPoint& p : c.points)
        text += identity(scene, c) +
                fmt::format("point,{},{},{},{}", p.samples, cells(p.error), cells(p.seconds),
                            name_of(p.trust)) +
                tail(c, cells(p.gain));
    for (const TimeToError& t : c.times)
        text += identity(scene, c) +
                fmt::format("time_to,{},{},,,{},{}", csv_field(t.samples), csv_field(t.error),
                            cells(t.seconds), name_of(t.reach)) +
                tail(c);
    return text;
}

}  // namespace

std::string cost_json(const CostReport& report)
{
    OrderedJson json = json_head("mis-cost/1", report);
    json["scenes"] = OrderedJson::array();
    for (const CostSceneReport& s : report.scenes) json["scenes"].push_back(scene_json(s));
    return json_text(json);
}

std::string cost_csv(const CostReport& report)
{
    std::string text =
        "scene,file,strategy,precision,kind,samples,error,error_low,error_high,seconds,seconds_low,"
        "seconds_high,mark,slope,slope_low,slope_high,slope_in_time,slope_in_time_low,"
        "slope_in_time_high,reason,gain,gain_low,gain_high\r\n";
    for (const CostSceneReport& scene : report.scenes)
        for (const CostCurveReport& curve : scene.curves) text += rows(scene, curve);
    return text;
}

}  // namespace mis
