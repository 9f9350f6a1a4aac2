#include "mis/io/report_read.h"

#include "mis/io/json_node.h"
#include "mis/io/text_file.h"
#include "mis/scene/nearest_name.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace mis {
namespace {

constexpr std::string_view guide = "See docs/report-format.md.";

bool is_null(const JsonNode& node) { return node.value().is_null(); }

double known_or_nan(const JsonNode& node)
{
    if (is_null(node)) return std::numeric_limits<double>::quiet_NaN();
    if (!node.maybe_number()) node.fail_value("a number, or null, belongs here", node.guide());
    return node.number();
}

/// At least 0, or not known.
double size_of(const JsonNode& node)
{
    const double value = known_or_nan(node);
    if (value < 0) node.fail_value("a number that is at least 0, or null, belongs here", "");
    return value;
}

Interval interval_of_sizes(const JsonNode& node)
{
    const Interval x{size_of(node["value"]), size_of(node["low"]), size_of(node["high"])};
    if (x.low > x.high) node["low"].fail_value("low is at most high", node.guide());
    return x;
}

template <class Count> Count count_of(const JsonNode& node, std::uint64_t least)
{
    return static_cast<Count>(node.whole_number(least, std::numeric_limits<Count>::max()));
}

/// Known ones in the order in which they are explained, then others as they stand.
void put_in_order(std::vector<EffectPlan>& effects)
{
    std::ranges::stable_sort(effects, {}, [](const EffectPlan& e) {
        return std::ranges::find(effect_names, e.name) - effect_names.begin();
    });
}

template <class T, class... Context>
T described_by(const JsonNode& node, const Context&... context);

/// Reads every field that it is told of (report/field.h) from an object. What older reports lack is
/// left as it is; a number is then not known.
class JsonReader {
public:
    explicit JsonReader(const JsonNode& node) : node_(node) {}

    void format(const Field& f, std::string_view name)
    {
        const JsonNode found = node_[f.key];
        if (found.string() != name)
            found.fail_value("this version reads " + in_quotes(name), node_.guide());
    }
    void text(const Field& f, std::string& x)
    {
        if (const auto found = find(f)) x = found->string();
    }
    void text_or_null(const Field& f, std::string& x)
    {
        if (const auto found = find(f)) x = is_null(*found) ? "" : found->string();
    }
    /// absent: of reports that lack it.
    void flag(const Field& f, bool& x, bool absent = false)
    {
        const auto found = find(f);
        if (found && !found->value().is_boolean())
            found->fail_value("true or false belongs here", node_.guide());
        x = found ? found->value().get<bool>() : absent;
    }
    template <class Count> void count(const Field& f, Count& x, std::uint64_t least = 0)
    {
        if (const auto found = find(f)) x = count_of<Count>(*found, least);
    }
    void place(const Field& f, int& x)
    {
        const auto found = find(f);
        x = !found || is_null(*found) ? 0 : count_of<int>(*found, 1);
    }
    void number(const Field& f, double& x)
    {
        const JsonNode found = node_[f.key];
        x = found.maybe_number().value_or(-1);
        if (!(x >= 0)) found.fail_value("a number that is at least 0 belongs here", node_.guide());
    }
    void figure(const Field& f, double& x)
    {
        const auto found = find(f);
        x = found ? known_or_nan(*found) : std::numeric_limits<double>::quiet_NaN();
    }
    void size(const Field& f, double& x)
    {
        const auto found = find(f);
        x = found ? size_of(*found) : std::numeric_limits<double>::quiet_NaN();
    }
    void interval(const Field& f, Interval& x)
    {
        if (const auto found = find(f)) x = interval_of_sizes(*found);
    }
    void value_and_interval(const Field& f, Interval& x)
    {
        const std::string key = interval_key(f);
        const JsonNode value = node_[f.key];
        x = interval_of_sizes(node_[key]);
        if (!std::isnan(known_or_nan(value)) || !std::isnan(x.value))
            if (known_or_nan(value) != x.value)
                value.fail_value("it is the value of \"" + key + "\"", node_.guide());
    }
    template <class E, class Names> void one_of(const Field& f, E& x, const Names& names)
    {
        const auto found = find(f);
        if (!found) return;
        const std::vector<std::string_view> known(names.begin(), names.end());
        for (std::size_t i = 0; i < known.size(); ++i)
            if (found->string() == known[i]) return void(x = static_cast<E>(i));
        found->fail_value("known are " + comma_list(known),
                          did_you_mean(found->string(), known, node_.guide()));
    }
    void names(const Field& f, std::vector<std::string>& x)
    {
        const auto found = find(f);
        for (std::size_t i = 0; found && i < found->size(); ++i)
            x.push_back(found->element(i).string());
    }
    void sizes(const Field& f, std::map<std::string, double>& x)
    {
        each_member(
            f, [&](const std::string& name, const JsonNode& node) { x[name] = size_of(node); });
    }
    void strategy_name(const Field& f, const Strategy&) { name_key_ = f.key; }
    /// The last of a strategy's fields. It is taken by its parts, not all of which need be known
    /// here; its name says the same.
    void draws(const Field& f, Strategy& s)
    {
        constexpr int most_draws = 1'000'000;
        const JsonNode counts = node_[f.key], name = node_[name_key_];
        counts.require_array(2, "two whole numbers belong here");
        for (std::size_t i = 0; i < 2; ++i)
            s.counts[i] = static_cast<int>(counts.element(i).whole_number(0, most_draws));
        if (name.string() != name_of(s))
            name.fail_value("the strategy that its other keys describe is " + in_quotes(name_of(s)),
                            node_.guide());
    }
    void resolution(const Field& f, int& width, int& height)
    {
        const JsonNode found = node_[f.key];
        if (is_null(found)) return;
        found.require_array(2, "two whole numbers, [width, height], or null, belong here");
        width = count_of<int>(found.element(0), 1);
        height = count_of<int>(found.element(1), 1);
    }
    void reason(const Field& f, Reason& why)
    {
        std::string words;
        text_or_null(f, words);
        if (!words.empty()) why = reason::AsWritten{words};
    }
    void index(const Field& f, int& i, const StrategyIndex& strategies)
    {
        const JsonNode name = node_[f.key];
        const auto found = strategies.find(name.string());
        if (!found)
            name.fail_value("the name of a strategy of this scene belongs here", node_.guide());
        i = *found;
    }
    template <class T> void object(const Field& f, T& x)
    {
        if (const auto found = find(f)) x = described_by<T>(*found);
    }
    template <class T> void maybe(const Field& f, std::optional<T>& x)
    {
        const auto found = find(f);
        if (found && !is_null(*found)) x = described_by<T>(*found);
    }
    template <class T, class... Context>
    void list(const Field& f, std::vector<T>& all, const Context&... context)
    {
        const auto found = find(f);
        for (std::size_t i = 0; found && i < found->size(); ++i)
            all.push_back(described_by<T>(found->element(i), context...));
    }
    void unique(const Field& f, std::vector<StrategyReport>& all)
    {
        list(f, all);
        std::set<std::string> names;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (!names.insert(name_of(all[i].strategy)).second)
                node_[f.key].element(i)["name"].fail_value("a strategy stands in a scene once",
                                                           "Remove one of the two.");
    }
    void by_name(const Field& f, std::vector<EffectPlan>& all)
    {
        each_member(f, [&](const std::string& name, const JsonNode& node) {
            all.push_back(described_by<EffectPlan>(node));
            all.back().name = name;
        });
        put_in_order(all);
    }
    template <class... Subject> void sentences(const Field&, const Subject&...) {}

private:
    /// Nothing where older reports may lack it.
    std::optional<JsonNode> find(const Field& f) const
    {
        return f.is_later ? node_.find(f.key) : std::optional(node_[f.key]);
    }
    template <class Read> void each_member(const Field& f, const Read& read)
    {
        const JsonNode found = node_[f.key];
        found.require_object();
        for (const auto& [name, value] : found.value().items()) read(name, found.at(name, value));
    }

    const JsonNode& node_;
    std::string_view name_key_;
};

template <class T, class... Context> T described_by(const JsonNode& node, const Context&... context)
{
    T value{};
    JsonReader reader(node);
    describe(reader, value, context...);
    return value;
}

}  // namespace

Report parse_report(std::string_view content, const std::filesystem::path& file,
                    const StopToken& stop)
{
    const Json document = parse_json(content, file, "", {}, stop);
    const std::string name = file.string();
    return described_by<Report>(JsonNode(document, name, guide));
}

Report read_report(const std::filesystem::path& file, const StopToken& stop)
{
    return parse_report(read_text_file(file, "report", stop), file, stop);
}

}  // namespace mis
