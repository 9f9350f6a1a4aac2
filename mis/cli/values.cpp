#include "mis/cli/values.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace mis::cli {

namespace {

/// The number that `text` begins with, which is cut off; nothing where it begins with none.
template <class Number> std::optional<Number> take_number(std::string_view& text)
{
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

/// The number of that type that the whole text is.
template <class Number> std::optional<Number> whole(std::string_view text)
{
    const std::optional<Number> number = take_number<Number>(text);
    return text.empty() ? number : std::nullopt;
}

constexpr std::array<std::pair<std::string_view, double>, 6> units{
    {{"", 1}, {"ms", 1e-3}, {"s", 1}, {"m", 60}, {"min", 60}, {"h", 3600}}};

/// What stands between commas; as many as there are commas, and one.
std::vector<std::string> words_of_list(const std::string& text)
{
    std::vector<std::string> words;
    std::size_t begin = 0;
    for (std::size_t comma; (comma = text.find(',', begin)) != text.npos; begin = comma + 1)
        words.push_back(text.substr(begin, comma - begin));
    words.push_back(text.substr(begin));
    return words;
}

}  // namespace

Fault whole_number_fault(std::uint64_t least, std::uint64_t most, const std::string& what)
{
    return [=](const std::string& text) {
        const auto number = whole<std::uint64_t>(text);
        if (number && *number >= least && *number <= most) return std::string();
        return fmt::format("found \"{}\"; {} is a whole number from {} to {}", text, what, least,
                           most);
    };
}

std::string integer_fault(const std::string& text)
{
    if (whole<std::int64_t>(text)) return "";
    return fmt::format("found \"{}\"; a whole number of samples is needed", text);
}

std::optional<double> number_in(const std::string& text) { return whole<double>(text); }

std::string number_fault(const std::string& text)
{
    if (number_in(text)) return "";
    return fmt::format("found \"{}\"; a number is needed", text);
}

std::vector<double> numbers_in(const std::string& text)
{
    std::vector<double> numbers;
    for (const std::string& word : words_of_list(text))
        numbers.push_back(number_in(word).value_or(0));  // number_list_fault() was asked
    return numbers;
}

std::string number_list_fault(const std::string& text)
{
    for (const std::string& word : words_of_list(text))
        if (const std::string fault = number_fault(word); !fault.empty()) return fault;
    return "";
}

Fault empty_fault(const std::string& allowed)
{
    return [allowed](const std::string& text) {
        return text.empty() ? "found \"\"; " + allowed + " is needed" : "";
    };
}

std::optional<double> seconds_in(const std::string& text)
{
    std::string_view rest = text;
    const std::optional<double> number = take_number<double>(rest);
    for (const auto& [unit, seconds] : units)
        if (number && rest == unit) return *number * seconds;
    return std::nullopt;
}

std::string duration_fault(const std::string& text)
{
    if (seconds_in(text)) return "";
    return fmt::format(
        "found \"{}\"; a time is a number of seconds, or has a unit: ms, s, m or h, "
        "as in 90, 500ms, 90s, 2m and 1.5h",
        text);
}

std::optional<std::array<int, 2>> pixel_in(const std::string& text)
{
    std::string_view rest = text;
    const std::optional<int> x = take_number<int>(rest);
    if (!x || !rest.starts_with(',')) return std::nullopt;
    const std::optional<int> y = whole<int>(rest.substr(1));
    return y && *x >= 0 && *y >= 0 ? std::optional(std::array{*x, *y}) : std::nullopt;
}

std::string pixel_fault(const std::string& text)
{
    if (pixel_in(text)) return "";
    return fmt::format("found \"{}\"; a pixel is its column and row, as in 12,7", text);
}

}  // namespace mis::cli
