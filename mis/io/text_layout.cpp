#include "mis/io/text_layout.h"

#include "mis/words/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mis {

std::size_t width_of(const std::string& text)
{
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
    return text.size() -
           static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues));
}

namespace {

/// Words, where "2 %" and "3.4 ± 0.2" are one.
std::vector<std::string> words_of(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> words;
    bool joins = false;
    for (std::string word; stream >> word;) {
        if (!words.empty() && (joins || word[0] == '%' || word == "±")) words.back() += " " + word;
        else words.push_back(word);
        joins = word == "±";
    }
    return words;
}

}  // namespace

namespace {

/// The mark, if `text` begins with one that turns the direction of writing (Unicode Standard Annex
/// 9, Bidi_Control); else 0. In UTF-8 each is three bytes.
unsigned direction_mark(std::string_view text)
{
    if (text.size() < 3 || text[0] != '\xE2') return 0;
    const unsigned second = static_cast<unsigned char>(text[1]),
                   third = static_cast<unsigned char>(text[2]);
    const unsigned code = 0x2000 + ((second & 0x3F) << 6) + (third & 0x3F);
    const bool is_mark = code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) ||
                         (code >= 0x2066 && code <= 0x2069);
    return is_mark ? code : 0;
}

}  // namespace

std::string printable(std::string_view text)
{
    std::string safe;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
        const bool is_c1 = byte == 0xC2 && next >= 0x80 && next < 0xA0;
        if (const unsigned mark = direction_mark(text.substr(i)); mark != 0)
            safe += fmt::format("\\u{:04x}", mark), i += 2;
        else if (is_c1) safe += fmt::format("\\u{:04x}", next), ++i;
        else if (byte < 0x20 || byte == 0x7F) safe += fmt::format("\\u{:04x}", byte);
        else safe += text[i];
    }
    return safe;
}

std::string wrapped(const std::string& text, std::size_t indent, std::size_t columns)
{
    std::string line, result;
    for (const std::string& each : words_of(text)) {
        const std::string word = printable(each);
        if (!line.empty() && width_of(line) + 1 + width_of(word) > columns) {
            result += line + "\n";
            line = std::string(indent, ' ') + word;
        } else {
            line += (line.empty() ? "" : " ") + word;
        }
    }
    return result + line + "\n";
}

std::string short_number(double value)
{
    if (!std::isfinite(value)) return "";
    const double size = std::fabs(value);
    if (size >= 999.5 && size < 999999.5) return fmt::format("{:.0f}", value);
    if (value == 0 || (size >= 1e-3 && size < 999.5)) return fmt::format("{:.3g}", value);
    const std::string text = fmt::format("{:.1e}", value);  // "1.2e-05", "1.2e+09"
    const std::size_t e = text.find('e');
    return text.substr(0, e + 1) + fmt::format("{}", std::stoi(text.substr(e + 1)));
}

std::string short_interval(const Interval& x)
{
    if (!(x.value > 0)) return short_number(x.value);
    const double error = std::max(x.high - x.value, x.value - x.low) / x.value;
    if (!std::isfinite(error) || error <= 0) return short_number(x.value);
    if (error > 0.5) return number(x.low, 2) + "-" + number(x.high, 2);
    return fmt::format("{}±{:.0f}%", short_number(x.value), std::ceil(100 * error - 1e-9));
}

std::string short_duration(double seconds)
{
    if (!std::isfinite(seconds)) return "";
    if (seconds >= 36e5) return fmt::format("{:.3g}d", seconds / 86400);
    if (seconds >= 5995) return fmt::format("{:.2g}h", seconds / 3600);
    if (seconds >= 99.5) return fmt::format("{:.2g}m", seconds / 60);
    if (seconds >= 0.0995 || seconds <= 0) return fmt::format("{:.2g}s", seconds);
    if (seconds >= 0.995e-4) return fmt::format("{:.2g}ms", 1e3 * seconds);
    return fmt::format("{:.2g}µs", 1e6 * seconds);
}

std::string many(std::size_t count, std::string_view what)
{
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void TextTable::add_remark(const std::string& first, const std::string& second,
                           const std::string& remark)
{
    rows_.push_back({first, second, remark});
}

std::vector<std::size_t> TextTable::widths() const
{
    std::vector<std::size_t> widths(heads_.front().size(), 0);
    for (const auto* lines : {&heads_, &rows_})
        for (const auto& row : *lines)
            for (std::size_t i = 0; i < (row.size() == 3 ? 2 : row.size()); ++i)
                widths[i] = std::max(widths[i], width_of(row[i]));
    std::size_t others = widths.size() - 1;  // the spaces between
    for (std::size_t i = 0; i < widths.size(); ++i) others += i == 1 ? 0 : widths[i];
    widths[1] = std::min(widths[1], text_columns > others + 8 ? text_columns - others : 8);
    return widths;
}

std::string TextTable::line(const std::vector<std::string>& cells,
                            const std::vector<std::size_t>& widths)
{
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (i > 0) text += ' ';
        const std::size_t width = width_of(cells[i]),
                          space = i < widths.size() && width < widths[i] ? widths[i] - width : 0;
        if (i == 1 && width > widths[1])
            text += cells[i] + "\n" + std::string(widths[0] + 1 + widths[1], ' ');
        else
            text +=
                i == 1 ? cells[i] + std::string(space, ' ') : std::string(space, ' ') + cells[i];
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
}

std::string TextTable::text() const
{
    const std::vector<std::size_t> columns = widths();
    std::size_t longest = 0;
    for (const auto& row : rows_)
        if (row.size() == 3) longest = std::max(longest, width_of(row[2]));
    const std::size_t room = text_columns - std::min(text_columns, columns[0] + 2 + longest);
    const std::vector<std::size_t> of_remark{columns[0], std::min(columns[1], room)};
    std::string text;
    for (const auto& head : heads_) text += line(head, columns);
    for (const auto& row : rows_) text += line(row, row.size() == 3 ? of_remark : columns);
    return text;
}

std::string setup_text(const std::optional<SetupSeconds>& setup)
{
    constexpr double short_time = 0.5;  // which nobody has waited for
    if (!setup || setup->all() < short_time) return "";
    return fmt::format(" after {} of reading and {} of building trees",
                       short_duration(setup->reading),
                       short_duration(setup->surfaces + setup->lights));
}

}  // namespace mis
