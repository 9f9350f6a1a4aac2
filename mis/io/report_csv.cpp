#include "mis/io/report_csv.h"

#include "mis/io/atomic_file.h"
#include "mis/io/csv_field.h"
#include "mis/words/reasons.h"

#include <fmt/format.h>

#include <vector>

namespace mis {
namespace {

std::string place_cell(int rank) { return rank > 0 ? fmt::format("{}", rank) : ""; }

void add(CsvRow& row, const std::string& column, const Interval& x)
{
    row.push_back({column, csv_field(x.value)});
    row.push_back({column + "_low", csv_field(x.low)});
    row.push_back({column + "_high", csv_field(x.high)});
}

std::string joined(const std::vector<std::string>& names)
{
    return fmt::format("{}", fmt::join(names, " "));
}

CsvRow row_of(const SceneReport& scene, const StrategyReport& s)
{
    const Strategy& strategy = s.strategy;
    const bool light_alone = strategy.heuristic == "light";
    CsvRow row{
        {"scene", csv_field(scene.name)},
        {"file", csv_field(scene.file)},
        {"strategy", csv_field(name_of(strategy))},
        {"policy", csv_field(strategy.policy)},
        {"heuristic", csv_field(strategy.heuristic)},
        {"technique", csv_field(strategy.technique)},
        {"model", strategy.model == Model::multi ? "multi" : "one-sample"},
        {"light_draws", fmt::format("{}", strategy.chooses_light() ? strategy.counts[0] : 0)},
        {"bsdf_draws", fmt::format("{}", !strategy.chooses_light() ? 1
                                         : light_alone             ? 0
                                                                   : strategy.counts[1])},
        {"status", name_of(s.status)},
        {"reason", csv_field(reason_words(s.reason))},
        {"exact", s.exact ? "true" : "false"},
        {"rank", place_cell(s.rank)},
        {"rank_low", place_cell(s.rank_low)},
        {"rank_high", place_cell(s.rank_high)},
        {"tied_with", csv_field(joined(s.tied_with))},
        {"rank_by_efficiency", place_cell(s.rank_by_efficiency)},
        {"rank_by_efficiency_low", place_cell(s.rank_by_efficiency_low)},
        {"rank_by_efficiency_high", place_cell(s.rank_by_efficiency_high)},
        {"samples", fmt::format("{}", s.samples)},
        {"mean", csv_field(s.mean)},
        {"mean_se", csv_field(s.mean_se)},
        {"bias_p_value", csv_field(s.bias_p_value)}};
    add(row, "variance", s.variance);
    add(row, "relative_variance", s.relative_variance);
    row.push_back({"rare_share", csv_field(s.rare_share)});
    row.push_back({"effective_samples", csv_field(s.effective_samples)});
    add(row, "seconds_per_point", s.seconds_per_point);
    add(row, "seconds_per_sample", s.seconds_per_sample);
    row.push_back({"rays_per_sample", csv_field(s.rays_per_sample)});
    add(row, "efficiency", s.efficiency);
    add(row, "seconds_to_1_percent", s.seconds_to_1_percent);
    row.push_back(
        {"estimated_seconds", s.status == Status::not_run ? csv_field(s.estimated_seconds) : ""});
    row.push_back({"invalid_samples", fmt::format("{}", s.invalid_samples)});
    return row;
}

}  // namespace

std::string report_csv(const Report& report)
{
    std::string text;
    StrategyReport any;
    any.strategy = {.policy = "", .heuristic = "", .technique = "brdf"};
    append_csv_line(text, row_of({}, any), &CsvCell::column);
    for (const SceneReport& scene : report.scenes)
        for (const StrategyReport& s : scene.strategies)
            append_csv_line(text, row_of(scene, s), &CsvCell::value);
    return text;
}

void write_report_csv(const Report& report, const std::string& path)
{
    write_text(path, report_csv(report));
}

}  // namespace mis
