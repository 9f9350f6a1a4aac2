#include "mis/io/json_faults.h"

#include "mis/io/encoding.h"
#include "mis/io/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <system_error>

namespace mis {
namespace {

constexpr const char* path_remedy =
    "Write paths with /, as in C:/scenes/plate.obj, or each \\ as \\\\.";

constexpr const char* finite_remedy = "Write a finite number, or leave the key out.";

bool is_word(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string_view("_+-.").find(c) != std::string_view::npos;
}

std::string lower(std::string_view text)
{
    std::string small(text);
    std::transform(small.begin(), small.end(), small.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return small;
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Text before a byte, on its line.
std::string_view line_before(std::string_view text, std::size_t byte)
{
    const std::string_view before = text.substr(0, byte);
    return before.substr(before.find_last_of("\r\n") + 1);  // npos + 1 is 0
}

/// A number as other languages write it: why it is none here, and what to do.
std::optional<std::array<std::string, 2>> number_fault(std::string_view word)
{
    const std::string_view digits = word.substr(word.starts_with('-') || word.starts_with('+'));
    if (digits.empty() || !(is_digit(digits[0]) || digits[0] == '.')) return {};
    const auto point = digits.find('.');
    const auto digit_at = [&](std::size_t i) { return i < digits.size() && is_digit(digits[i]); };
    if (digits.size() > 1 && digits[0] == '0' && (digits[1] | 0x20) == 'x')
        return std::array<std::string, 2>{"JSON has no hexadecimal numbers",
                                          "Write it in decimal."};
    if (word[0] == '+')
        return std::array<std::string, 2>{"a JSON number has no + before it", "Remove the +."};
    if (digits[0] == '0' && digit_at(1))
        return std::array<std::string, 2>{"a JSON number has no zero before its first digit",
                                          "Remove the zero."};
    if (point != digits.npos && (point == 0 || !digit_at(point + 1)))
        return std::array<std::string, 2>{"a JSON number has digits on both sides of its point",
                                          "Write 0.5, or 5.0."};
    double number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
        return std::array<std::string, 2>{"a JSON number has digits, a point and an exponent alone",
                                          "Write it as 1000, 0.5 or 1e-3."};
    return {};
}

std::optional<JsonFault> word_fault(std::string_view text, std::size_t byte)
{
    const std::string_view word = word_around(text, byte);
    if (word.empty()) return {};
    const auto start = static_cast<std::size_t>(word.data() - text.data());
    const std::string found = in_quotes(word), small = lower(word);
    const std::string_view unsigned_small =
        std::string_view(small).substr(small.starts_with('-') || small.starts_with('+'));
    for (const std::string_view name : {"nan", "inf", "infinity"})
        if (unsigned_small == name)
            return JsonFault{start, found, fmt::format("{} is no JSON number", word),
                             finite_remedy};
    constexpr std::array<std::array<std::string_view, 2>, 5> words{{{"none", "null"},
                                                                    {"undefined", "null"},
                                                                    {"null", "null"},
                                                                    {"true", "true"},
                                                                    {"false", "false"}}};
    for (const auto& [other, ours] : words)
        if (small == other && word != ours)
            return JsonFault{start, found, "JSON writes true, false and null, in small letters",
                             fmt::format("Write {}.", ours)};
    if (const auto why = number_fault(word)) return JsonFault{start, found, (*why)[0], (*why)[1]};
    const std::size_t next = text.find_first_not_of(" \t\r\n", start + word.size());
    const bool is_name = std::isalpha(static_cast<unsigned char>(word[0])) != 0 || word[0] == '_';
    if (is_name && next != text.npos && text[next] == ':')
        return JsonFault{start, found, "a key stands in double quotes",
                         fmt::format("Write {}.", in_quotes(word))};
    return {};
}

std::optional<JsonFault> character_fault(std::string_view text, std::size_t byte)
{
    if (text[byte] == '\'')
        return JsonFault{byte, "a single quote, '", "strings and keys stand in double quotes",
                         "Write \" in its place."};
    if (text[byte] == '#') {
        const std::string_view before = byte > 0 ? word_around(text, byte - 1) : "";
        if (before.ends_with('.')) {  // 1.#INF, -1.#IND, as old C libraries print them
            const std::string_view after = word_around(text, byte + 1);
            const std::string all = fmt::format("{}#{}", before, after);
            return JsonFault{byte - before.size(), in_quotes(all), all + " is no JSON number",
                             finite_remedy};
        }
        return JsonFault{byte, in_quotes("#"), "a comment begins with // or /*",
                         "Write // in its place."};
    }
    std::size_t first = byte;
    while (first > 0 && (static_cast<unsigned char>(text[first]) & 0xC0) == 0x80) --first;
    if (static_cast<unsigned char>(text[first]) < 0x80) return {};
    const std::string name = described_character(text.substr(first, 4));
    const std::string remedy = name.find("quote") != name.npos ? "Write \" in its place."
                               : name.find("minus") != name.npos || name.find("dash") != name.npos
                                   ? "Write - in its place."
                                   : "Remove it, or type it again.";
    return JsonFault{first, "the character " + name,
                     "between its strings JSON has plain ASCII characters alone", remedy};
}

/// Within a string.
std::optional<JsonFault> string_fault(std::string_view text, std::size_t byte,
                                      std::string_view reason)
{
    const auto says = [&](std::string_view words) { return reason.find(words) != reason.npos; };
    const std::size_t escape = text.rfind('\\', byte);
    if (says("surrogate"))
        return JsonFault{escape, in_quotes(text.substr(escape, byte - escape + 1)),
                         "\\uD800 to \\uDFFF are halves of one character, and stand in pairs",
                         "Write the character itself, or both of its halves."};
    if (says("backslash") || says("hex digits"))
        return JsonFault{
            escape, in_quotes(text.substr(escape, byte - escape + 1)),
            "in a string a backslash is written \\\\; it begins \\\" \\\\ \\/ \\b \\f \\n \\r \\t "
            "and \\uXXXX",
            path_remedy};
    if (byte >= text.size() || text[byte] == '\n' || text[byte] == '\r') {
        const bool quote_is_escaped = line_before(text, byte).find("\\\"") != text.npos;
        return JsonFault{
            byte,
            fmt::format("the end of the {} within a string", byte < text.size() ? "line" : "text"),
            "a string ends with \" on the line on which it begins",
            quote_is_escaped ? "In \\\" the quote is part of the text. "
                               "Write paths with /, or each \\ as \\\\."
                             : "Close it with \"."};
    }
    if (says("control character") && text[byte] == '\t')
        return JsonFault{byte, "a tab within a string", "in a string a tab is written \\t",
                         "Write \\t, or a blank."};
    return {};
}

}  // namespace

std::string_view word_around(std::string_view text, std::size_t byte)
{
    const auto in_word = [&](std::size_t i) { return i < text.size() && is_word(text[i]); };
    if (!in_word(byte) && byte > 0) --byte;
    if (!in_word(byte)) return {};
    std::size_t first = byte, end = byte;
    while (first > 0 && in_word(first - 1)) --first;
    while (in_word(end)) ++end;
    return text.substr(first, end - first);
}

std::optional<JsonFault> known_json_fault(std::string_view text, std::size_t byte,
                                          std::string_view reason)
{
    if (reason.find("invalid string") != reason.npos) return string_fault(text, byte, reason);
    if (byte >= text.size()) return {};
    if (auto fault = character_fault(text, byte)) return fault;
    const auto says = [&](std::string_view words) { return reason.find(words) != reason.npos; };
    if (says("object key") && says("number literal"))
        return JsonFault{byte, in_quotes(word_around(text, byte)),
                         "a key, in double quotes, belongs here",
                         "Write 0.5, not 0,5, if this is part of a number."};
    const bool may_be_just_before = says("invalid number") || says("invalid literal");
    if (!is_word(text[byte]) && !may_be_just_before) return {};
    return word_fault(text, byte);
}

}  // namespace mis
