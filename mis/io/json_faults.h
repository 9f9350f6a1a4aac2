#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mis {

/// What is wrong with a text that is no JSON, in words.
struct JsonFault {
    std::size_t byte;  ///< where it begins
    std::string found, allowed, remedy;
};

/// The fault, if it is one of those that people and programs are known for: NaN, words of Python,
/// quotes of other kinds, blanks that are not seen, a path's backslashes, numbers of other
/// languages. byte: where the parser stopped, text.size() at its end; reason: its own words.
std::optional<JsonFault> known_json_fault(std::string_view text, std::size_t byte,
                                          std::string_view reason);

/// The characters of words and numbers around a byte, or just before it; empty if there are none.
std::string_view word_around(std::string_view text, std::size_t byte);

}  // namespace mis
