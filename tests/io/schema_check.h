#pragma once

#include <nlohmann/json.hpp>

#include <stdexcept>
#include <string>

namespace mis {

/// The first place where `value` breaks `schema`, as "pointer: what"; empty if none. Knows the
/// words of JSON Schema that our schemas use (type, const, enum, required, properties,
/// additionalProperties, items, minItems, maxItems, minimum, maximum, exclusiveMinimum,
/// exclusiveMaximum, $ref into $defs, and anyOf/oneOf as "at least one"), and throws on any other.
class SchemaCheck {
public:
    explicit SchemaCheck(nlohmann::json schema) : root_(std::move(schema)) {}

    std::string first_fault(const nlohmann::json& value) const { return fault(value, root_, ""); }

private:
    using Json = nlohmann::json;

    static bool has_type(const Json& value, const std::string& type)
    {
        if (type == "integer") return value.is_number_integer();
        if (type == "number") return value.is_number();
        return type == value.type_name();
    }

    static bool has_one_of_types(const Json& value, const Json& types)
    {
        if (types.is_string()) return has_type(value, types);
        for (const Json& type : types)
            if (has_type(value, type)) return true;
        return false;
    }

    std::string fault(const Json& value, const Json& schema, const std::string& at) const
    {
        if (schema == true) return "";
        for (const auto& [word, rule] : schema.items())
            if (std::string found = fault_by(word, rule, value, schema, at); !found.empty())
                return found;
        return "";
    }

    std::string fault_by(const std::string& word, const Json& rule, const Json& value,
                         const Json& schema, const std::string& at) const
    {
        if (word == "$ref")
            return fault(value, root_.at(Json::json_pointer(rule.get<std::string>().substr(1))),
                         at);
        if (word == "type")
            return has_one_of_types(value, rule)
                       ? ""
                       : at + ": is " + value.type_name() + ", not " + rule.dump();
        if (word == "const") return value == rule ? "" : at + ": is not " + rule.dump();
        if (word == "enum")
            return std::find(rule.begin(), rule.end(), value) != rule.end()
                       ? ""
                       : at + ": is none of " + rule.dump();
        if (word == "required") return value.is_object() ? missing(value, rule, at) : "";
        if (word == "properties" || word == "additionalProperties")
            return members(word, value, schema, at);
        if (word == "items") return elements(value, rule, at);
        if (word == "minItems")
            return !value.is_array() || value.size() >= rule ? "" : at + ": too few";
        if (word == "maxItems")
            return !value.is_array() || value.size() <= rule ? "" : at + ": too many";
        if (word == "minimum") return !value.is_number() || value >= rule ? "" : at + ": too small";
        if (word == "maximum") return !value.is_number() || value <= rule ? "" : at + ": too large";
        if (word == "exclusiveMinimum")
            return !value.is_number() || value > rule ? "" : at + ": too small";
        if (word == "exclusiveMaximum")
            return !value.is_number() || value < rule ? "" : at + ": too large";
        if (word == "anyOf" || word == "oneOf") return none_of(value, rule, at);
        if (word == "$schema" || word == "$id" || word == "title" || word == "description" ||
            word == "$defs" || word == "default" || word == "examples")
            return "";
        throw std::runtime_error("the test knows no \"" + word + "\"");
    }

    static std::string missing(const Json& value, const Json& required, const std::string& at)
    {
        for (const std::string key : required)
            if (!value.contains(key)) return at + ": lacks \"" + key + "\"";
        return "";
    }

    std::string members(const std::string& word, const Json& value, const Json& schema,
                        const std::string& at) const
    {
        if (!value.is_object()) return "";
        const Json known = schema.value("properties", Json::object());
        for (const auto& [key, member] : value.items()) {
            std::string found;
            if (known.contains(key)) {
                if (word == "properties") found = fault(member, known.at(key), at + "/" + key);
            } else if (word == "additionalProperties") {
                found = schema.at(word) == false ? at + ": has an unknown \"" + key + "\""
                                                 : fault(member, schema.at(word), at + "/" + key);
            }
            if (!found.empty()) return found;
        }
        return "";
    }

    std::string elements(const Json& value, const Json& rule, const std::string& at) const
    {
        if (!value.is_array()) return "";
        for (std::size_t i = 0; i < value.size(); ++i)
            if (std::string found = fault(value[i], rule, at + "/" + std::to_string(i));
                !found.empty())
                return found;
        return "";
    }

    std::string none_of(const Json& value, const Json& rules, const std::string& at) const
    {
        std::string last;
        for (const Json& rule : rules)
            if ((last = fault(value, rule, at)).empty()) return "";
        return last;
    }

    Json root_;
};

}  // namespace mis
