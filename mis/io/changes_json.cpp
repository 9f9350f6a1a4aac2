#include "mis/io/changes_json.h"

#include "mis/io/csv_field.h"
#include "mis/io/json_parts.h"
#include "mis/io/report_json.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <vector>

namespace mis {
namespace {

std::string verdict(const Change& change)
{
    return !change.is_compared() ? "" : change.is_changed ? "changed" : "~";
}

const char* status(const std::optional<Status>& s) { return s ? name_of(*s) : ""; }

const char* name_of_change(ChangingFigure figure)
{
    return figure == ChangingFigure::mean ? "difference" : "ratio";
}

OrderedJson json_of(ChangingFigure figure, const Change& change)
{
    return {{"before", json_figure(change.before)},
            {"after", json_figure(change.after)},
            {name_of_change(figure), json_interval(change.by)},
            {"verdict", json_text_or_null(verdict(change))},
            {"regression", change.is_regression}};
}

OrderedJson json_of(const StrategyChange& s)
{
    OrderedJson json{{"name", s.name},
                     {"status_before", json_text_or_null(status(s.status_before))},
                     {"status_after", json_text_or_null(status(s.status_after))},
                     {"exact_before", s.exact_before},
                     {"exact_after", s.exact_after},
                     {"newly_biased", s.is_newly_biased()}};
    for (std::size_t i = 0; i < figures_that_change; ++i) {
        const auto figure = static_cast<ChangingFigure>(i);
        json[name_of(figure)] = json_of(figure, s.figures[i]);
    }
    return json;
}

OrderedJson json_of(const SceneChange& scene)
{
    OrderedJson json{{"name", scene.name},
                     {"file_before", json_text_or_null(scene.file_before)},
                     {"file_after", json_text_or_null(scene.file_after)},
                     {"remarks", scene.remarks},
                     {"strategies", OrderedJson::array()}};
    for (const StrategyChange& s : scene.strategies) json["strategies"].push_back(json_of(s));
    return json;
}

void add(CsvRow& row, ChangingFigure figure, const Change& change)
{
    const std::string name = name_of(figure), by = name + "_" + name_of_change(figure);
    row.insert(row.end(), {{name + "_before", csv_field(change.before)},
                           {name + "_after", csv_field(change.after)},
                           {by, csv_field(change.by.value)},
                           {by + "_low", csv_field(change.by.low)},
                           {by + "_high", csv_field(change.by.high)},
                           {name + "_verdict", verdict(change)},
                           {name + "_regression", change.is_regression ? "true" : "false"}});
}

CsvRow row_of(const SceneChange& scene, const StrategyChange& s)
{
    CsvRow row{{"scene", csv_field(scene.name)},
               {"file_before", csv_field(scene.file_before)},
               {"file_after", csv_field(scene.file_after)},
               {"strategy", csv_field(s.name)},
               {"status_before", status(s.status_before)},
               {"status_after", status(s.status_after)},
               {"exact_before", s.exact_before ? "true" : "false"},
               {"exact_after", s.exact_after ? "true" : "false"}};
    for (std::size_t i = 0; i < figures_that_change; ++i)
        add(row, static_cast<ChangingFigure>(i), s.figures[i]);
    return row;
}

}  // namespace

std::string changes_json(const Changes& changes, const ChangesHeader& header)
{
    OrderedJson json{{"format", "mis-changes/1"},
                     {"version", header.version},
                     {"command", header.command},
                     {"file_before", header.file_before},
                     {"file_after", header.file_after},
                     {"error", json_figure(changes.error)},
                     {"comparisons", changes.comparisons},
                     {"changed", changes.changed},
                     {"fail_on_regression", changes.worse_by ? json_figure(100 * *changes.worse_by)
                                                             : OrderedJson(nullptr)},
                     {"regression", changes.worse_by ? OrderedJson(changes.has_regression())
                                                     : OrderedJson(nullptr)},
                     {"remarks", changes.remarks},
                     {"scenes", OrderedJson::array()}};
    for (const SceneChange& scene : changes.scenes) json["scenes"].push_back(json_of(scene));
    return json_text(json);
}

std::string changes_csv(const Changes& changes)
{
    std::string text;
    append_csv_line(text, row_of({}, {}), &CsvCell::column);
    for (const SceneChange& scene : changes.scenes)
        for (const StrategyChange& s : scene.strategies)
            append_csv_line(text, row_of(scene, s), &CsvCell::value);
    return text;
}

}  // namespace mis
