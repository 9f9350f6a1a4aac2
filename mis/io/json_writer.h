#pragma once

#include "mis/io/json_parts.h"
#include "mis/report/report.h"
#include "mis/words/reasons.h"
#include "mis/words/verdict.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mis {

/// The JSON of what describe() knows. context: what describe() takes beside it.
template <class T, class... Context>
OrderedJson described_json(const T& value, const Context&... context);

/// Writes every field that it is told of (report/field.h) into an object, in order.
class JsonWriter {
public:
    explicit JsonWriter(OrderedJson& object) : object_(object) {}

    void format(const Field& f, std::string_view name) { put(f, name); }
    void text(const Field& f, const std::string& x) { put(f, x); }
    void text_or_null(const Field& f, const std::string& x) { put(f, json_text_or_null(x)); }
    void flag(const Field& f, bool x, bool = false) { put(f, x); }
    template <class Count> void count(const Field& f, const Count& x, int = 0) { put(f, x); }
    void place(const Field& f, int x) { put(f, x > 0 ? OrderedJson(x) : OrderedJson(nullptr)); }
    void number(const Field& f, double x) { put(f, json_figure(x)); }
    void figure(const Field& f, double x) { put(f, json_figure(x)); }
    void size(const Field& f, double x) { put(f, json_figure(x)); }
    void interval(const Field& f, const Interval& x) { put(f, json_interval(x)); }
    void value_and_interval(const Field& f, const Interval& x)
    {
        put(f, json_figure(x.value));
        object_[interval_key(f)] = json_interval(x);
    }
    template <class E, class Names> void one_of(const Field& f, E x, const Names& names)
    {
        put(f, names[static_cast<std::size_t>(x)]);
    }
    void names(const Field& f, const std::vector<std::string>& x) { put(f, x); }
    void sizes(const Field& f, const std::map<std::string, double>& x)
    {
        OrderedJson all = OrderedJson::object();
        for (const auto& [name, size] : x) all[name] = json_figure(size);
        put(f, std::move(all));
    }
    void strategy_name(const Field& f, const Strategy& s) { put(f, name_of(s)); }
    void draws(const Field& f, const Strategy& s) { put(f, draws_of(s)); }
    void resolution(const Field& f, int width, int height)
    {
        put(f, json_resolution(width, height));
    }
    template <class Why> void reason(const Field& f, const Why& why)
    {
        put(f, json_text_or_null(reason_words(why)));
    }
    void index(const Field& f, int i, const StrategyIndex& strategies)
    {
        put(f, strategies.name(i));
    }
    template <class T> void object(const Field& f, const T& x) { put(f, described_json(x)); }
    template <class T> void maybe(const Field& f, const std::optional<T>& x)
    {
        put(f, x ? described_json(*x) : OrderedJson(nullptr));
    }
    template <class T, class... Context>
    void list(const Field& f, const std::vector<T>& all, const Context&... context)
    {
        OrderedJson array = OrderedJson::array();
        for (const T& each : all) array.push_back(described_json(each, context...));
        put(f, std::move(array));
    }
    template <class T> void unique(const Field& f, const std::vector<T>& all) { list(f, all); }
    template <class T> void by_name(const Field& f, const std::vector<T>& all)
    {
        OrderedJson object = OrderedJson::object();
        for (const T& each : all) object[each.name] = described_json(each);
        put(f, std::move(object));
    }
    void sentences(const Field& f, const SceneReport& scene, const Report& report)
    {
        put(f, sentences_of(scene, report.threads, report.margin));
    }
    void sentences(const Field& f, const Report& report) { put(f, overall_sentences_of(report)); }

private:
    template <class Value> void put(const Field& f, Value&& value)
    {
        object_[std::string(f.key)] = std::forward<Value>(value);
    }

    OrderedJson& object_;
};

template <class T, class... Context>
OrderedJson described_json(const T& value, const Context&... context)
{
    OrderedJson object = OrderedJson::object();
    JsonWriter writer(object);
    describe(writer, value, context...);
    return object;
}

}  // namespace mis
