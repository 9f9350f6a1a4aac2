#include "mis/io/report_csv.h"

#include "mis/io/atomic_file.h"
#include "mis/io/csv_field.h"
#include "mis/words/reasons.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mis {
namespace {

/// Adds a cell for every field of a strategy that it is told of and that the table has.
class RowWriter {
public:
    explicit RowWriter(CsvRow& row) : row_(row) {}

    void text(const Field& f, const std::string& x) { put(f, csv_field(x)); }
    void text_or_null(const Field& f, const std::string& x) { put(f, csv_field(x)); }
    void flag(const Field& f, bool x) { put(f, x ? "true" : "false"); }
    template <class Count> void count(const Field& f, const Count& x)
    {
        put(f, fmt::format("{}", x));
    }
    void place(const Field& f, int x) { put(f, x > 0 ? fmt::format("{}", x) : ""); }
    void figure(const Field& f, double x) { put(f, csv_field(x)); }
    void size(const Field& f, double x) { put(f, csv_field(x)); }
    void interval(const Field& f, const Interval& x)
    {
        put(f, csv_field(x.value));
        put(f, csv_field(x.low), "_low");
        put(f, csv_field(x.high), "_high");
    }
    void value_and_interval(const Field& f, const Interval& x) { interval(f, x); }
    template <class E, class Names> void one_of(const Field& f, E x, const Names& names)
    {
        put(f, names[static_cast<std::size_t>(x)]);
    }
    void names(const Field& f, const std::vector<std::string>& x)
    {
        put(f, csv_field(fmt::format("{}", fmt::join(x, " "))));
    }
    void strategy_name(const Field& f, const Strategy& s) { put(f, csv_field(name_of(s))); }
    void draws(const Field&, const Strategy& s)
    {
        const auto [light, bsdf] = draws_of(s);
        row_.push_back({"light_draws", fmt::format("{}", light)});
        row_.push_back({"bsdf_draws", fmt::format("{}", bsdf)});
    }
    void reason(const Field& f, const Reason& why) { put(f, csv_field(reason_words(why))); }

    // A table has no room for what is many.
    template <class T> void sizes(const Field&, const T&) {}
    template <class T> void object(const Field&, const T&) {}
    template <class T> void maybe(const Field&, const T&) {}
    template <class T> void list(const Field&, const T&) {}

private:
    void put(const Field& f, std::string cell, std::string_view end = {})
    {
        if (f.column.empty()) return;
        row_.push_back({std::string(f.column) + std::string(end), std::move(cell)});
    }

    CsvRow& row_;
};

CsvRow row_of(const SceneReport& scene, const StrategyReport& s)
{
    CsvRow row{{"scene", csv_field(scene.name)}, {"file", csv_field(scene.file)}};
    RowWriter writer(row);
    describe(writer, s);
    return row;
}

}  // namespace

std::string report_csv(const Report& report)
{
    std::string text;
    append_csv_line(text, row_of({}, {}), &CsvCell::column);
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
