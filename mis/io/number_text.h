#pragma once

#include <optional>
#include <string_view>

namespace mis {

/// What is wrong with a text that should be a number.
struct NumberProblem {
    const char *allowed, *remedy;
};

/// Reads `text`, all of it, as a finite number: "1", "+1", ".5", "5.", "1e-3", whatever the locale.
/// What a double cannot hold (1e999) or would round to 0 (1e-999), NaN and infinity are problems.
std::optional<NumberProblem> read_number_text(std::string_view text, double& number);

}  // namespace mis
