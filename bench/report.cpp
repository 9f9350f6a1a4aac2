#include "bench/report.h"

#include "mis/engine/pipeline.h"
#include "mis/io/text_layout.h"  // width_of, short_number

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mis::bench {

namespace {

using Rows = std::vector<std::vector<std::string>>;

/// Columns as wide as they must be; the first `to_left` and the last to the left, the others to the
/// right.
std::string aligned(const Rows& rows, std::size_t to_left)
{
    std::vector<std::size_t> widths(rows.front().size());
    for (const auto& row : rows)
        for (std::size_t k = 0; k < row.size(); ++k)
            widths[k] = std::max(widths[k], width_of(row[k]));
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t k = 0; k < row.size(); ++k) {
            const std::string space(widths[k] - width_of(row[k]), ' ');
            const bool is_left = k < to_left || k + 1 == row.size();
            line += (k > 0 ? "  " : "") + (is_left ? row[k] + space : space + row[k]);
        }
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::string limit_of(const Bar& bar)
{
    if (bar.sense == Bar::Sense::report) return "";
    return (bar.sense == Bar::Sense::at_most ? "≤ " : "≥ ") + short_number(bar.limit);
}

std::string verdict_of(const Bar& bar)
{
    return bar.sense == Bar::Sense::report ? "" : bar.is_reached() ? "reached" : "MISSED";
}

std::string interval_of(const Middle& m)
{
    return m.low == m.high ? "" : fmt::format("{:.3g}-{:.3g}", m.low, m.high);
}

std::string bars_table(const Bars& bars)
{
    Rows table{{"bar", "what", "limit", "median", "quartiles", "", ""}};
    for (const Bar& bar : bars)
        if (bar.value.is_known())
            table.push_back({std::to_string(bar.number), bar.what, limit_of(bar),
                             fmt::format("{:.3g}", bar.value.median), interval_of(bar.value),
                             verdict_of(bar), bar.remark});
    return table.size() > 1 ? aligned(table, 2) : "";
}

/// Where the time goes: ns per sample, by stage.
std::string stages_table(const Figures& figures)
{
    std::vector<std::string> heads{"ns per sample", "all"};
    for (const std::string_view stage : stage_names)
        heads.emplace_back(stage == "light_occlusion" ? "lights" : stage);
    heads.emplace_back("rays per");
    Rows table{heads};
    for (const auto& entry : figures.all()) {
        const std::string& name = entry.first;
        if (!entry.second.contains("ns_per_sample") || !entry.second.contains("ns_prepare"))
            continue;
        const auto ns = [&](const std::string& counter) {
            const double median = figures.at(name, counter).median;
            return median < 0.05 ? std::string("-") : fmt::format("{:.1f}", median);
        };
        std::vector<std::string> row{name, ns("ns_per_sample")};
        for (const std::string_view stage : stage_names)
            row.push_back(ns("ns_" + std::string(stage)));
        row.push_back(fmt::format("{:.2f}", figures.at(name, "rays_per_sample").median));
        table.push_back(row);
    }
    return table.size() > 1 ? "\n" + aligned(table, 1) : "";
}

nlohmann::json json_of_middle(const Middle& m)
{
    return {{"median", m.median}, {"low", m.low}, {"high", m.high}};
}

}  // namespace

std::string table_of(const Bars& bars, const Figures& figures, const Setting& setting)
{
    return fmt::format("{}, kernels {}, medians of {} repetitions, interleaved\n\n",
                       setting.machine, setting.instruction_set, setting.repetitions) +
           bars_table(bars) + stages_table(figures);
}

std::string json_of(const Bars& bars, const Figures& figures, const Setting& setting)
{
    nlohmann::ordered_json document{{"format", "mis-bench/1"},
                                    {"version", MIS_VERSION},
                                    {"machine", setting.machine},
                                    {"instruction_set", setting.instruction_set},
                                    {"repetitions", setting.repetitions}};
    document["bars"] = nlohmann::json::array();
    for (const Bar& bar : bars) {
        if (!bar.value.is_known()) continue;
        nlohmann::ordered_json entry{
            {"bar", bar.number}, {"what", bar.what}, {"value", json_of_middle(bar.value)}};
        if (bar.sense != Bar::Sense::report) {
            entry[bar.sense == Bar::Sense::at_most ? "at_most" : "at_least"] = bar.limit;
            entry["reached"] = bar.is_reached();
        }
        if (!bar.remark.empty()) entry["remark"] = bar.remark;
        document["bars"].push_back(entry);
    }
    document["benchmarks"] = figures.all();
    return document.dump(1) + "\n";
}

}  // namespace mis::bench
