#include "mis/io/report_json.h"

#include "mis/io/atomic_file.h"
#include "mis/io/json_parts.h"
#include "mis/words/reasons.h"
#include "mis/words/verdict.h"

namespace mis {
namespace {

OrderedJson place(int rank) { return rank > 0 ? OrderedJson(rank) : OrderedJson(nullptr); }

OrderedJson probe(const PointFigures& p)
{
    return {{"mean", json_figure(p.mean)},
            {"mean_se", json_figure(p.mean_se)},
            {"variance", json_interval(p.variance)}};
}

OrderedJson strategy(const StrategyReport& s)
{
    OrderedJson json = json_identity(s.strategy);
    json["status"] = name_of(s.status);
    json["reason"] = json_text_or_null(reason_words(s.reason));
    json["exact"] = s.exact;
    json["rank"] = place(s.rank);
    json["rank_low"] = place(s.rank_low);
    json["rank_high"] = place(s.rank_high);
    json["tied_with"] = s.tied_with;
    json["rank_by_efficiency"] = place(s.rank_by_efficiency);
    json["rank_by_efficiency_low"] = place(s.rank_by_efficiency_low);
    json["rank_by_efficiency_high"] = place(s.rank_by_efficiency_high);
    json["samples"] = s.samples;
    json["mean"] = json_figure(s.mean);
    json["mean_se"] = json_figure(s.mean_se);
    json["bias_p_value"] = json_figure(s.bias_p_value);
    json["variance"] = json_interval(s.variance);
    json["relative_variance"] = json_interval(s.relative_variance);
    json["rare_share"] = json_figure(s.rare_share);
    json["effective_samples"] = json_figure(s.effective_samples);
    json["timed_rounds"] = s.timed_rounds;
    json["seconds_per_point"] = json_interval(s.seconds_per_point);
    json["seconds_per_sample"] = json_interval(s.seconds_per_sample);
    json["stage_seconds"] = OrderedJson::object();
    for (const auto& [stage, seconds] : s.stage_seconds)
        json["stage_seconds"][stage] = json_figure(seconds);
    json["rays_per_sample"] = json_figure(s.rays_per_sample);
    json["efficiency"] = json_interval(s.efficiency);
    json["seconds_to_1_percent"] = json_figure(s.seconds_to_1_percent.value);
    json["seconds_to_1_percent_interval"] = json_interval(s.seconds_to_1_percent);
    json["estimated_seconds"] =
        s.status == Status::not_run ? json_figure(s.estimated_seconds) : OrderedJson(nullptr);
    json["invalid_samples"] = s.invalid_samples;
    json["probes"] = OrderedJson::array();
    for (const PointFigures& p : s.probes) json["probes"].push_back(probe(p));
    return json;
}

OrderedJson pair(const PairReport& p, const SceneReport& scene)
{
    return {{"a", name_of(scene.strategies[p.a].strategy)},
            {"b", name_of(scene.strategies[p.b].strategy)},
            {"variance_ratio", json_interval(p.ratio)},
            {"verdict", name_of(p.verdict)},
            {"more_replicates", json_figure(p.more_replicates)},
            {"efficiency_ratio", json_interval(p.efficiency_ratio)},
            {"efficiency_verdict", name_of(p.efficiency_verdict)},
            {"time_ratio", json_interval(p.time_ratio)},
            {"time_verdict", name_of(p.time_verdict)}};
}

OrderedJson effect(const EffectPlan& e)
{
    return {{"on", e.on},
            {"share", json_figure(e.share)},
            {"why", e.why},
            {"saved_rays_per_sample", json_figure(e.saved_rays_per_sample)},
            {"saved_seconds_per_sample", json_figure(e.saved_seconds_per_sample)}};
}

OrderedJson scene(const SceneReport& s, const Report& report)
{
    OrderedJson json{{"file", s.file},
                     {"name", s.name},
                     {"lights", s.lights},
                     {"surfaces", s.surfaces},
                     {"triangles", s.triangles},
                     {"resolution", json_resolution(s.width, s.height)},
                     {"shading_points", s.shading_points},
                     {"background_pixels", s.background_pixels},
                     {"replicates", s.replicates},
                     {"epsilon", json_figure(s.epsilon)},
                     {"settled", s.settled},
                     {"partial", s.partial},
                     {"seconds", json_figure(s.seconds)}};
    json["effects"] = OrderedJson::object();
    for (const EffectPlan& e : s.effects) json["effects"][e.name] = effect(e);
    json["strategies"] = OrderedJson::array();
    for (const StrategyReport& each : s.strategies) json["strategies"].push_back(strategy(each));
    json["pairs"] = OrderedJson::array();
    for (const PairReport& p : s.pairs) json["pairs"].push_back(pair(p, s));
    json["sentences"] = sentences_of(s, report.threads, report.margin);
    return json;
}

OrderedJson overall(const OverallReport& o)
{
    return {{"name", o.name},
            {"rank", place(o.rank)},
            {"rank_by_efficiency", place(o.rank_by_efficiency)},
            {"variance_ratio", json_interval(o.variance_ratio)},
            {"cost_ratio", json_interval(o.cost_ratio)},
            {"time_ratio", json_interval(o.time_ratio)},
            {"beaten_by_exact", o.beaten_by_exact}};
}

}  // namespace

std::string report_json(const Report& report)
{
    OrderedJson json = json_head(report_format, report);
    json["margin"] = json_figure(report.margin);
    json["at"] = json_figure(report.at);
    json["scenes"] = OrderedJson::array();
    for (const SceneReport& s : report.scenes) json["scenes"].push_back(scene(s, report));
    json["overall"] = OrderedJson::array();
    for (const OverallReport& o : report.overall) json["overall"].push_back(overall(o));
    json["sentences"] = overall_sentences_of(report);
    return json_text(json);
}

void write_report_json(const Report& report, const std::string& path)
{
    write_text(path, report_json(report));
}

}  // namespace mis
