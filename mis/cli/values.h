#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace mis::cli {

// What the text of an option must be. A fault is the end of a message, empty where there is none:
// what was found, and what is allowed.

using Fault = std::function<std::string(const std::string& text)>;

/// Of a whole number in that range; the parser's own conversion would wrap −1 around.
Fault whole_number_fault(std::uint64_t least, std::uint64_t most, const std::string& what);

/// Of a whole number that is checked later, with the others.
std::string integer_fault(const std::string& text);

/// The number that the whole text is.
std::optional<double> number_in(const std::string& text);

/// Of a number; nan and inf are some, and are refused where their option is read.
std::string number_fault(const std::string& text);

/// The numbers of a list "16,64,256"; and of its first word that is none.
std::vector<double> numbers_in(const std::string& text);
std::string number_list_fault(const std::string& text);

/// Of an empty word, as of a variable that was not set.
Fault empty_fault(const std::string& allowed);

/// Seconds of a duration: "90", "90s", "2m", "2min", "1.5h", "500ms"; nothing of other texts.
std::optional<double> seconds_in(const std::string& text);
std::string duration_fault(const std::string& text);

/// Column and row of "X,Y"; nothing of other texts.
std::optional<std::array<int, 2>> pixel_in(const std::string& text);
std::string pixel_fault(const std::string& text);

}  // namespace mis::cli
