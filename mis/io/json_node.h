#pragma once

#include "mis/io/json_document.h"
#include "mis/math/vec.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace mis {

/// A value of a document, and where it stands: typed access whose errors name file, pointer and
/// what was found. A node refers to its parent, which must outlive it; pointers are spelt out only
/// when something is wrong.
class JsonNode {
public:
    /// The whole document. `file` as the user named it; `guide`: where its format is described, as
    /// a sentence for messages.
    JsonNode(const Json& document, std::string_view file,
             std::string_view guide = "See docs/scene-format.md.")
        : value_(&document), file_(file), guide_(guide)
    {
    }

    /// A member of an object; an error if there is none.
    JsonNode operator[](std::string_view key) const;
    std::optional<JsonNode> find(std::string_view key) const;
    /// Where a member stands whose value is not at hand (it was streamed).
    JsonNode at(std::string_view key, const Json& value) const { return {*this, key, 0, value}; }
    /// Where an element stands that was handed out by itself.
    JsonNode at(std::size_t index, const Json& value) const { return {*this, {}, index, value}; }

    /// Error unless this is an object whose keys are all among `known`; the nearest known key is
    /// offered.
    void require_keys(std::span<const std::string_view> known) const;

    std::size_t size() const;                   ///< of an array; an error if it is none
    JsonNode element(std::size_t index) const;  ///< of an array, index < size()

    double number() const;
    std::uint64_t whole_number(std::uint64_t low, std::uint64_t high) const;  ///< low ≤ n ≤ high
    int pixels() const;  ///< a whole number of any sign that an int holds; its range is
                         ///< scene/validate's matter
    const std::string& string() const;
    Vec3<double> vector() const;                 ///< [x, y, z]
    Vec3<double> color() const;                  ///< [r, g, b], or a number for all three
    std::optional<double> maybe_number() const;  ///< nothing if this is no number
    void require_object() const;
    void require_array(std::size_t size, std::string_view allowed) const;

    std::string pointer() const;
    std::string_view file() const { return file_; }
    std::string guide() const { return std::string(guide_); }
    const Json& value() const { return *value_; }

    /// Throws SceneError about this value.
    [[noreturn]] void fail(std::string found, std::string allowed, std::string remedy) const;
    /// The same with the value itself as what was found.
    [[noreturn]] void fail_value(std::string allowed, std::string remedy) const;

private:
    JsonNode(const JsonNode& parent, std::string_view key, std::size_t index, const Json& value)
        : value_(&value), parent_(&parent), key_(key), index_(index), file_(parent.file_),
          guide_(parent.guide_)
    {
    }

    const Json* value_;
    const JsonNode* parent_ = nullptr;
    std::string_view key_;   ///< in an object; null in an array
    std::size_t index_ = 0;  ///< in an array
    std::string_view file_, guide_;
};

/// A value in a message: short, on one line, safe to print.
std::string shown(const Json& value);

}  // namespace mis
