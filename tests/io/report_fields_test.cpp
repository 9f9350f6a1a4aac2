// What describe() says of a report, against its schema, its page of documentation and its table.
#include "mis/io/json_parts.h"
#include "mis/io/report_csv.h"
#include "tests/io/sample_report.h"
#include "tests/support/places.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <list>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace mis {
namespace {

const char* definition_of(const SceneReport&) { return "scene"; }
const char* definition_of(const SetupSeconds&) { return "setup_seconds"; }
const char* definition_of(const EffectPlan&) { return "effect"; }
const char* definition_of(const StrategyReport&) { return "strategy"; }
const char* definition_of(const AuditedGrowth&) { return "growth"; }
const char* definition_of(const SampleName&) { return "sample"; }
const char* definition_of(const PointFigures&) { return "probe"; }
const char* definition_of(const CountFigures&) { return "count"; }
const char* definition_of(const PairReport&) { return "pair"; }
const char* definition_of(const OverallReport&) { return "overall"; }

OrderedJson reference_to(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }
OrderedJson array_of(const OrderedJson& items) { return {{"type", "array"}, {"items", items}}; }
OrderedJson by_names(const OrderedJson& each)
{
    return {{"type", "object"}, {"additionalProperties", each}};
}
OrderedJson two_integers(const OrderedJson& type, int least)
{
    return {{"type", type},
            {"items", {{"type", "integer"}, {"minimum", least}}},
            {"minItems", 2},
            {"maxItems", 2}};
}

OrderedJson object_of(const OrderedJson& required, const OrderedJson& properties)
{
    return {{"type", "object"},
            {"required", required},
            {"additionalProperties", false},
            {"properties", properties}};
}

/// A JSON Schema of every field that it is told of (report/field.h).
class SchemaWriter {
public:
    explicit SchemaWriter(OrderedJson& definitions) : definitions_(definitions) {}

    OrderedJson schema() const { return object_of(required_, properties_); }
    /// What a table of these fields has in its header.
    const std::vector<std::string>& columns() const { return columns_; }

    void format(const Field& f, std::string_view name) { put(f, {{"const", name}}); }
    void text(const Field& f, const std::string&) { put(f, {{"type", "string"}}); }
    void text_or_null(const Field& f, const std::string&)
    {
        put(f, {{"type", {"string", "null"}}});
    }
    void flag(const Field& f, bool, bool = false) { put(f, {{"type", "boolean"}}); }
    template <class Count> void count(const Field& f, const Count&, int least = 0)
    {
        put(f, {{"type", "integer"}, {"minimum", least}});
    }
    void place(const Field& f, int) { put(f, reference_to("place")); }
    void number(const Field& f, double) { put(f, {{"type", "number"}, {"minimum", 0}}); }
    void figure(const Field& f, double) { put(f, reference_to("figure")); }
    void size(const Field& f, double) { put(f, reference_to("size")); }
    void interval(const Field& f, const Interval&)
    {
        put(f, reference_to("interval"));
        add_columns_of_interval(f);
    }
    void value_and_interval(const Field& f, const Interval&)
    {
        put(f, reference_to("size"));
        add_columns_of_interval(f);
        const std::string& key = interval_keys_.emplace_back(interval_key(f));
        put(Field(key, f.unit).outside_table(), reference_to("interval"));
    }
    template <class E, class Names> void one_of(const Field& f, E, const Names& names)
    {
        put(f, {{"enum", names}});
    }
    void names(const Field& f, const std::vector<std::string>&)
    {
        put(f, array_of({{"type", "string"}}));
    }
    void sizes(const Field& f, const std::map<std::string, double>&)
    {
        put(f, by_names(reference_to("size")));
    }
    void strategy_name(const Field& f, const Strategy&) { put(f, {{"type", "string"}}); }
    void draws(const Field& f, const Strategy&)
    {
        put(f.as("light_draws"), two_integers("array", 0));
        columns_.push_back("bsdf_draws");
    }
    void resolution(const Field& f, int, int) { put(f, two_integers({"array", "null"}, 1)); }
    void reason(const Field& f, const Reason&) { put(f, {{"type", {"string", "null"}}}); }
    void index(const Field& f, int, const StrategyIndex&) { put(f, {{"type", "string"}}); }
    template <class T> void object(const Field& f, const T& x) { put(f, defined(x)); }
    template <class T> void maybe(const Field& f, const std::optional<T>&)
    {
        put(f, {{"anyOf", {defined(T{}), {{"type", "null"}}}}});
    }
    template <class T, class... Context>
    void list(const Field& f, const std::vector<T>&, const Context&... context)
    {
        put(f, array_of(defined(T{}, context...)));
    }
    template <class T> void unique(const Field& f, const std::vector<T>& all) { list(f, all); }
    template <class T> void by_name(const Field& f, const std::vector<T>&)
    {
        put(f, by_names(defined(T{})));
    }
    template <class... Subject> void sentences(const Field& f, const Subject&...)
    {
        put(f, array_of({{"type", "string"}}));
    }

private:
    void put(const Field& f, OrderedJson rule)
    {
        if (!f.unit.empty()) rule["description"] = f.unit;
        if (!f.is_later) required_.push_back(f.key);
        properties_[std::string(f.key)] = std::move(rule);
        if (!f.column.empty()) columns_.push_back(std::string(f.column));
    }
    void add_columns_of_interval(const Field& f)
    {
        for (const char* end : {"_low", "_high"}) columns_.push_back(std::string(f.column) + end);
    }
    /// Adds its definition; a reference to it.
    template <class T, class... Context>
    OrderedJson defined(const T& value, const Context&... context)
    {
        const std::string name = definition_of(value);
        SchemaWriter writer(definitions_);
        definitions_[name];  // before those that it needs
        describe(writer, value, context...);
        definitions_[name] = writer.schema();
        return reference_to(name);
    }

    OrderedJson& definitions_;
    OrderedJson required_ = OrderedJson::array(), properties_ = OrderedJson::object();
    std::list<std::string> interval_keys_;
    std::vector<std::string> columns_{};
};

/// The whole schema, as docs/report.schema.json has it.
OrderedJson schema_of_reports()
{
    const OrderedJson size = reference_to("size");
    OrderedJson definitions{{"figure", {{"type", {"number", "null"}}}},
                            {"size", {{"type", {"number", "null"}}, {"minimum", 0}}},
                            {"place", {{"type", {"integer", "null"}}, {"minimum", 1}}},
                            {"interval", {{"description", "A figure and its 95 % interval."}}}};
    definitions["interval"].update(
        object_of({"value", "low", "high"}, {{"value", size}, {"low", size}, {"high", size}}));
    SchemaWriter writer(definitions);
    const Report report;
    describe(writer, report);
    OrderedJson schema{
        {"$schema", "https://json-schema.org/draft/2020-12/schema"},
        {"title", report_format},
        {"description",
         "What `mis compare` found. Numbers that are not known or not finite are null. "
         "A description is a unit. See report-format.md."}};
    schema.update(writer.schema());
    schema["$defs"] = definitions;
    return schema;
}

TEST(ReportFields, AreWhatTheSchemaLists)
{
    const OrderedJson written =
        OrderedJson::parse(std::ifstream(source_dir() / "docs/report.schema.json"));
    EXPECT_EQ(written, schema_of_reports()) << schema_of_reports().dump(2);
}

TEST(ReportFields, AreTheColumnsOfTheTable)
{
    OrderedJson definitions;
    SchemaWriter writer(definitions);
    const StrategyReport strategy;
    describe(writer, strategy);
    std::string header = "scene,file";
    for (const std::string& column : writer.columns()) header += "," + column;
    EXPECT_EQ(report_csv({}), header + "\r\n");
    EXPECT_NE(header.find(",efficiency,efficiency_low,efficiency_high,seconds_to_1_percent,"),
              header.npos);
}

/// A member that is added to a StrategyReport is described, too, and then named here.
TEST(ReportFields, AreAllMembersOfAStrategyReport)
{
    const StrategyReport s;
    const auto& [strategy, status, reason, exact, rank, rank_low, rank_high, by, by_low, by_high,
                 tied_with, may_be_best, behind, samples, mean, mean_se, from, variance,
                 relative_variance, timed_rounds, per_point, per_sample, stages, rays, efficiency,
                 to_1_percent, estimated, least_bias, p_value, rare_share, factor, growth,
                 effective, invalid, first_invalid, probes, at_counts] = s;
    EXPECT_EQ(&strategy, &s.strategy);
    EXPECT_EQ(&at_counts, &s.at_counts);
    constexpr std::size_t members = 37, parts_of_strategy = 6;
    OrderedJson definitions;
    SchemaWriter writer(definitions);
    describe(writer, s);
    // The time to 1 % has two keys.
    EXPECT_EQ(writer.schema()["properties"].size(), members - 1 + parts_of_strategy + 1);
}

/// The text of docs/report-format.md under a heading.
std::string section(const std::string& heading)
{
    std::ifstream file(source_dir() / "docs/report-format.md");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::size_t begin = text.find("\n## " + heading + "\n");
    return begin == text.npos ? "" : text.substr(begin + 1, text.find("\n#", begin + 1) - begin);
}

/// What stands in `backticks`, in order.
std::vector<std::string> in_backticks(const std::string& text)
{
    std::vector<std::string> words;
    for (std::size_t at = 0; (at = text.find('`', at)) != text.npos;) {
        const std::size_t end = text.find('`', at + 1);
        if (end == text.npos) break;
        words.push_back(text.substr(at + 1, end - at - 1));
        at = end + 1;
    }
    return words;
}

/// The keys that the first cells of a section's table name, each with the row that says so.
std::map<std::string, std::string> explained_keys(const std::string& heading)
{
    std::map<std::string, std::string> rows;
    std::istringstream lines(section(heading));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("| `"))
            for (const std::string& key : in_backticks(line.substr(0, line.find('|', 1))))
                rows[key] = line;
    return rows;
}

std::set<std::string> keys_of(const OrderedJson& definition)
{
    std::set<std::string> keys;
    for (const auto& [key, rule] : definition["properties"].items()) keys.insert(key);
    return keys;
}

void expect_explained(const std::string& heading, const OrderedJson& definition)
{
    std::set<std::string> explained;
    for (const auto& [key, row] : explained_keys(heading)) explained.insert(key);
    EXPECT_EQ(explained, keys_of(definition)) << heading;
}

/// The keys of what stands under one key, in that key's row.
void expect_explained_in(const std::string& heading, const std::string& key,
                         const OrderedJson& definition)
{
    const std::vector<std::string> words = in_backticks(explained_keys(heading)[key]);
    for (const std::string& inner : keys_of(definition))
        EXPECT_TRUE(std::ranges::count(words, inner)) << heading << ": " << key << ": " << inner;
}

TEST(ReportFields, AreExplainedKeyByKey)
{
    const OrderedJson schema = schema_of_reports(), &of = schema["$defs"];
    expect_explained("The run", schema);
    expect_explained("A scene", of["scene"]);
    expect_explained("A strategy", of["strategy"]);
    expect_explained("A pair", of["pair"]);
    expect_explained("A count", of["count"]);
    expect_explained("Overall", of["overall"]);
    expect_explained_in("A scene", "effects", of["effect"]);
    expect_explained_in("A strategy", "probes", of["probe"]);
    expect_explained_in("A strategy", "first_invalid", of["sample"]);
    expect_explained_in("A strategy", "least_growth", of["growth"]);
}

}  // namespace
}  // namespace mis
