#include "mis/io/json_node.h"

#include "mis/io/scene_error.h"
#include "mis/io/text_file.h"
#include "mis/scene/nearest_name.h"
#include "mis/scene/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {

std::string shown(const Json& value)
{
    constexpr std::size_t longest = 60, most = 8;
    if (value.is_string()) return in_quotes(value.get_ref<const std::string&>());
    if (value.is_object()) return value.empty() ? "an empty object" : "an object";
    if (value.is_array() &&
        (value.size() > most ||
         std::any_of(value.begin(), value.end(), [](const Json& v) { return v.is_structured(); })))
        return fmt::format("an array of {}", value.size());
    const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return text.size() <= longest ? text : fmt::format("an array of {}", value.size());
}

JsonNode JsonNode::operator[](std::string_view key) const
{
    require_object();
    const auto member = value_->find(key);
    if (member == value_->end()) {
        static const Json nothing;
        at(key, nothing).fail("nothing", fmt::format("\"{}\" is required here", key), guide());
    }
    return at(key, *member);
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const
{
    require_object();
    const auto member = value_->find(key);
    if (member == value_->end()) return {};
    return at(key, *member);
}

void JsonNode::require_object() const
{
    if (!value_->is_object()) fail_value("an object, { ... }, belongs here", guide());
}

void JsonNode::require_keys(std::span<const std::string_view> known) const
{
    require_object();
    for (const auto& [key, value] : value_->items()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        at(key, value)
            .fail("the unknown key " + in_quotes(key), "known keys are " + comma_list(known),
                  did_you_mean(key, known, "Remove it."));
    }
}

std::size_t JsonNode::size() const
{
    if (!value_->is_array()) fail_value("an array, [ ... ], belongs here", guide());
    return value_->size();
}

JsonNode JsonNode::element(std::size_t index) const { return at(index, (*value_)[index]); }

void JsonNode::require_array(std::size_t size, std::string_view allowed) const
{
    if (!value_->is_array() || value_->size() != size) fail_value(std::string(allowed), guide());
}

std::optional<double> JsonNode::maybe_number() const
{
    if (!value_->is_number()) return {};
    return value_->get<double>();
}

double JsonNode::number() const
{
    if (!value_->is_number()) fail_value("a number belongs here", guide());
    return value_->get<double>();
}

std::uint64_t JsonNode::whole_number(std::uint64_t low, std::uint64_t high) const
{
    const std::string allowed =
        fmt::format("a whole number between {} and {} belongs here", low, high);
    constexpr double two_64 = 18446744073709551616.0;
    const double number = maybe_number().value_or(-1);
    if (!(number >= 0 && number < two_64 && number == std::floor(number)) &&
        !value_->is_number_unsigned())
        fail_value(allowed, "Write a number of this range, without a fraction.");
    const std::uint64_t whole = value_->is_number_unsigned() ? value_->get<std::uint64_t>()
                                                             : static_cast<std::uint64_t>(number);
    if (whole < low || whole > high) fail_value(allowed, "Write a number of this range.");
    return whole;
}

int JsonNode::pixels() const
{
    const double number = maybe_number().value_or(std::numeric_limits<double>::quiet_NaN());
    constexpr int largest = std::numeric_limits<int>::max();
    if (!(number == std::floor(number) && std::abs(number) <= largest))
        fail_value(fmt::format("a whole number between 1 and {} belongs here", limits::resolution),
                   guide());
    return static_cast<int>(number);
}

const std::string& JsonNode::string() const
{
    if (!value_->is_string()) fail_value("a string, in double quotes, belongs here", guide());
    return value_->get_ref<const std::string&>();
}

Vec3<double> JsonNode::vector() const
{
    require_array(3, "three numbers, [x, y, z], belong here");
    return {element(0).number(), element(1).number(), element(2).number()};
}

Vec3<double> JsonNode::color() const
{
    if (const std::optional<double> grey = maybe_number()) return Vec3<double>(*grey);
    require_array(3, "a number, or three, [r, g, b], belong here");
    return {element(0).number(), element(1).number(), element(2).number()};
}

std::string JsonNode::pointer() const
{
    if (!parent_) return {};
    return parent_->pointer() + "/" + (key_.data() ? pointer_token(key_) : to_text(index_));
}

void JsonNode::fail(std::string found, std::string allowed, std::string remedy) const
{
    throw SceneError(file_,
                     Problem{pointer(), std::move(found), std::move(allowed), std::move(remedy)});
}

void JsonNode::fail_value(std::string allowed, std::string remedy) const
{
    fail(shown(*value_), std::move(allowed), std::move(remedy));
}

}  // namespace mis
