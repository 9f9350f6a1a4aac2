#include "mis/io/report_read.h"

#include "mis/io/json_node.h"
#include "mis/io/report_json.h"
#include "mis/io/text_file.h"
#include "mis/words/numbers.h"

#include <nlohmann/json.hpp>

#include <array>
#include <limits>
#include <map>

namespace mis {
namespace {

constexpr std::string_view guide = "See docs/report-format.md.";
constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
constexpr int most_int = std::numeric_limits<int>::max();

bool is_null(const JsonNode& node) { return node.value().is_null(); }

double figure(const JsonNode& node)
{
    if (is_null(node)) return std::numeric_limits<double>::quiet_NaN();
    if (!node.maybe_number()) node.fail_value("a number, or null, belongs here", node.guide());
    return node.number();
}

/// At least 0, or not known.
double size(const JsonNode& node)
{
    const double value = figure(node);
    if (value < 0) node.fail_value("a number that is at least 0, or null, belongs here", "");
    return value;
}

Interval interval(const JsonNode& node)
{
    const Interval x{size(node["value"]), size(node["low"]), size(node["high"])};
    if (x.low > x.high) node["low"].fail_value("low is at most high", node.guide());
    return x;
}

std::uint64_t count(const JsonNode& node) { return node.whole_number(0, most); }
int small_count(const JsonNode& node) { return static_cast<int>(node.whole_number(0, most_int)); }

/// A rank; 0 for null.
int place(const JsonNode& node)
{
    return is_null(node) ? 0 : static_cast<int>(node.whole_number(1, most_int));
}

std::string text(const JsonNode& node) { return is_null(node) ? "" : node.string(); }

bool truth(const JsonNode& node)
{
    if (!node.value().is_boolean()) node.fail_value("true or false belongs here", node.guide());
    return node.value().get<bool>();
}

template <class Read> auto list_of(const JsonNode& node, const Read& read)
{
    std::vector<decltype(read(node))> all;
    for (std::size_t i = 0; i < node.size(); ++i) all.push_back(read(node.element(i)));
    return all;
}

/// Whichever of `values` has that name.
template <class Value, std::size_t N, class Name>
Value one_of(const JsonNode& node, const std::array<Value, N>& values, const Name& name)
{
    std::string known;
    for (const Value value : values) {
        if (node.string() == name(value)) return value;
        known += (known.empty() ? "" : ", ") + std::string(name(value));
    }
    node.fail_value("known are " + known, node.guide());
}

Status status(const JsonNode& node)
{
    return one_of(node,
                  std::array{Status::not_run, Status::not_resolved, Status::biased, Status::ranked},
                  [](Status s) { return name_of(s); });
}

Verdict verdict(const JsonNode& node)
{
    return one_of(node, std::array{Verdict::apart, Verdict::tied, Verdict::undecided},
                  [](Verdict v) { return name_of(v); });
}

/// By its parts, not all of which need be known here.
Strategy strategy(const JsonNode& node)
{
    constexpr int most_draws = 1'000'000;
    Strategy s{.policy = text(node["policy"]),
               .heuristic = text(node["heuristic"]),
               .technique = node["technique"].string()};
    s.model = one_of(node["model"], std::array{Model::multi, Model::one_sample},
                     [](Model m) { return m == Model::multi ? "multi" : "one-sample"; });
    const JsonNode counts = node["counts"];
    counts.require_array(2, "two whole numbers belong here");
    for (std::size_t i = 0; i < 2; ++i)
        s.counts[i] = static_cast<int>(counts.element(i).whole_number(0, most_draws));
    if (node["name"].string() != name_of(s))
        node["name"].fail_value(
            "the strategy that its other keys describe is " + in_quotes(name_of(s)), node.guide());
    return s;
}

PointFigures read_probe(const JsonNode& node)
{
    return {figure(node["mean"]), size(node["mean_se"]), interval(node["variance"])};
}

void read_ranks(const JsonNode& node, StrategyReport& s)
{
    s.rank = place(node["rank"]);
    s.rank_low = place(node["rank_low"]);
    s.rank_high = place(node["rank_high"]);
    s.tied_with = list_of(node["tied_with"], [](const JsonNode& name) { return name.string(); });
    s.rank_by_efficiency = place(node["rank_by_efficiency"]);
    s.rank_by_efficiency_low = place(node["rank_by_efficiency_low"]);
    s.rank_by_efficiency_high = place(node["rank_by_efficiency_high"]);
}

void read_times(const JsonNode& node, StrategyReport& s)
{
    if (const auto rounds = node.find("timed_rounds")) s.timed_rounds = small_count(*rounds);
    s.seconds_per_point = interval(node["seconds_per_point"]);
    s.seconds_per_sample = interval(node["seconds_per_sample"]);
    const JsonNode stages = node["stage_seconds"];
    stages.require_object();
    for (const auto& [stage, seconds] : stages.value().items())
        s.stage_seconds[stage] = size(stages.at(stage, seconds));
    s.rays_per_sample = size(node["rays_per_sample"]);
    s.efficiency = interval(node["efficiency"]);
    s.seconds_to_1_percent = interval(node["seconds_to_1_percent_interval"]);
    s.estimated_seconds = size(node["estimated_seconds"]);
}

StrategyReport strategy_report(const JsonNode& node)
{
    StrategyReport s;
    s.strategy = strategy(node);
    s.status = status(node["status"]);
    if (const std::string why = text(node["reason"]); !why.empty())
        s.reason = reason::AsWritten{why};
    s.exact = truth(node["exact"]);
    read_ranks(node, s);
    s.samples = count(node["samples"]);
    s.mean = figure(node["mean"]);
    s.mean_se = size(node["mean_se"]);
    s.bias_p_value = size(node["bias_p_value"]);
    s.variance = interval(node["variance"]);
    s.relative_variance = interval(node["relative_variance"]);
    s.rare_share = size(node["rare_share"]);
    s.effective_samples = size(node["effective_samples"]);
    read_times(node, s);
    s.invalid_samples = count(node["invalid_samples"]);
    s.probes = list_of(node["probes"], read_probe);
    return s;
}

/// Strategies by name, each name once.
std::map<std::string, int> indices(const JsonNode& strategies, const SceneReport& scene)
{
    std::map<std::string, int> index;
    for (std::size_t i = 0; i < scene.strategies.size(); ++i)
        if (!index.emplace(name_of(scene.strategies[i].strategy), static_cast<int>(i)).second)
            strategies.element(i)["name"].fail_value("a strategy stands in a scene once",
                                                     "Remove one of the two.");
    return index;
}

PairReport pair(const JsonNode& node, const std::map<std::string, int>& index)
{
    const auto member = [&](const JsonNode& name) {
        const auto found = index.find(name.string());
        if (found == index.end())
            name.fail_value("the name of a strategy of this scene belongs here", node.guide());
        return found->second;
    };
    PairReport p{.a = member(node["a"]), .b = member(node["b"])};
    p.ratio = interval(node["variance_ratio"]);
    p.verdict = verdict(node["verdict"]);
    p.more_replicates = size(node["more_replicates"]);
    p.efficiency_ratio = interval(node["efficiency_ratio"]);
    p.efficiency_verdict = verdict(node["efficiency_verdict"]);
    p.time_ratio = interval(node["time_ratio"]);
    p.time_verdict = verdict(node["time_verdict"]);
    return p;
}

EffectPlan effect(const std::string& name, const JsonNode& node)
{
    return {name,
            truth(node["on"]),
            size(node["share"]),
            node["why"].string(),
            figure(node["saved_rays_per_sample"]),
            figure(node["saved_seconds_per_sample"])};
}

void read_resolution(const JsonNode& node, SceneReport& s)
{
    if (is_null(node)) return;
    node.require_array(2, "two whole numbers, [width, height], or null, belong here");
    s.width = static_cast<int>(node.element(0).whole_number(1, most_int));
    s.height = static_cast<int>(node.element(1).whole_number(1, most_int));
}

SceneReport read_scene(const JsonNode& node)
{
    SceneReport s;
    s.file = node["file"].string();
    s.name = node["name"].string();
    s.lights = count(node["lights"]);
    s.surfaces = count(node["surfaces"]);
    s.triangles = count(node["triangles"]);
    read_resolution(node["resolution"], s);
    s.shading_points = count(node["shading_points"]);
    s.background_pixels = count(node["background_pixels"]);
    s.replicates = small_count(node["replicates"]);
    s.epsilon = size(node["epsilon"]);
    s.settled = truth(node["settled"]);
    s.partial = truth(node["partial"]);
    s.seconds = size(node["seconds"]);
    const JsonNode effects = node["effects"];
    effects.require_object();
    for (const auto& [name, value] : effects.value().items())
        s.effects.push_back(effect(name, effects.at(name, value)));
    s.strategies = list_of(node["strategies"], strategy_report);
    const std::map<std::string, int> index = indices(node["strategies"], s);
    s.pairs = list_of(node["pairs"], [&](const JsonNode& each) { return pair(each, index); });
    return s;
}

OverallReport read_overall(const JsonNode& node)
{
    return {.name = node["name"].string(),
            .rank = place(node["rank"]),
            .rank_by_efficiency = place(node["rank_by_efficiency"]),
            .variance_ratio = interval(node["variance_ratio"]),
            .cost_ratio = interval(node["cost_ratio"]),
            .time_ratio = interval(node["time_ratio"]),
            .beaten_by_exact = small_count(node["beaten_by_exact"])};
}

}  // namespace

Report parse_report(std::string_view content, const std::filesystem::path& file)
{
    const Json document = parse_json(content, file, "", {});
    const std::string name = file.string();
    const JsonNode root(document, name, guide);
    if (root["format"].string() != report_format)
        root["format"].fail_value("this version reads " + in_quotes(report_format), root.guide());
    Report report{{.version = root["version"].string(),
                   .command = root["command"].string(),
                   .machine = root["machine"].string(),
                   .instruction_set = root["instruction_set"].string()}};
    report.seed = count(root["seed"]);
    if (const auto sampler = root.find("sampler"))
        report.is_sobol = one_of(*sampler, std::array{false, true}, sampler_name);
    report.threads = static_cast<int>(root["threads"].whole_number(1, most_int));
    report.partial = truth(root["partial"]);
    report.margin = size(root["margin"]);
    report.at = size(root["at"]);
    report.scenes = list_of(root["scenes"], read_scene);
    report.overall = list_of(root["overall"], read_overall);
    return report;
}

Report read_report(const std::filesystem::path& file)
{
    return parse_report(read_text_file(file, "report"), file);
}

}  // namespace mis
