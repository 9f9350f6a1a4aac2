#include "mis/io/number_text.h"

#include <charconv>
#include <cmath>

namespace mis {

std::optional<NumberProblem> read_number_text(std::string_view text, double& number)
{
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc::result_out_of_range && rest == end)
        return NumberProblem{"a number lies within the range of a double", "Use other units."};
    if (error != std::errc{} || rest != end || !std::isfinite(number))
        return NumberProblem{"a finite number belongs here", "Write it as 0.5 or 1e-3."};
    return {};
}

}  // namespace mis
