#include "mis/io/text_layout.h"

#include "mis/words/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <sstream>
#include <utility>

namespace mis {

std::size_t width_of(const std::string& text)
{
    const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
    return text.size() -
           static_cast<std::size_t>(std::count_if(text.begin(), text.end(), continues));
}

namespace {

bool ends_number(const std::string& word)
{
    return std::isdigit(static_cast<unsigned char>(word.back())) != 0 || word.ends_with(')');
}

/// "(9.2", which "to 13)" follows.
bool opens_interval(const std::string& word)
{
    const std::size_t open = word.rfind('(');
    return open != word.npos && word.find(')', open) == word.npos && open + 1 < word.size() &&
           (std::isdigit(static_cast<unsigned char>(word[open + 1])) != 0 || word[open + 1] == '-');
}

/// Does `next` belong to the figure that `words` end with: "2 %", "3.4 ± 0.2", "11 (9.2 to 13) µs"?
bool goes_on(const std::string& words, const std::string& next)
{
    constexpr std::array<std::string_view, 6> units{"s", "ms", "µs", "min", "h", "days"};
    const std::string bare = next.substr(0, next.find_last_not_of(".,;:)") + 1);
    return next[0] == '%' || next == "±" || words.ends_with("±") || opens_interval(words) ||
           (ends_number(words) &&
            (std::ranges::find(units, bare) != units.end() || opens_interval(next)));
}

/// Words, where a figure with its interval and unit is one.
std::vector<std::string> words_of(const std::string& text)
{
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) {
        if (!words.empty() && goes_on(words.back(), word)) words.back() += " " + word;
        else words.push_back(word);
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

namespace {

/// Where a line goes on: behind its first run of two blanks or more, if that is not too far right;
/// else two places behind its beginning.
std::size_t hanging_indent(const std::string& line, std::size_t columns)
{
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t gap = line.find("  ", begin);
    const std::size_t text = gap == line.npos ? line.npos : line.find_first_not_of(' ', gap);
    if (text != line.npos && 2 * text <= columns) return text;
    return std::min(begin + 2, columns / 2);
}

std::string fitted_line(const std::string& line, std::size_t columns)
{
    if (width_of(line) <= columns || line.starts_with("    mis ")) return line;
    const std::string indent(hanging_indent(line, columns), ' ');
    std::string text, rest = line;
    while (width_of(rest) > columns) {
        const std::size_t begin = std::min(rest.find_first_not_of(' '), rest.size());
        std::size_t last = rest.npos;
        for (std::size_t at = rest.find(' ', begin);
             at != rest.npos && (last == rest.npos || width_of(rest.substr(0, at)) <= columns);
             at = rest.find(' ', at + 1))
            if (at > indent.size()) last = at;
        if (last == rest.npos) break;
        text += rest.substr(0, last) + "\n";
        rest = indent + rest.substr(std::min(rest.find_first_not_of(' ', last), rest.size()));
    }
    return text + rest;
}

}  // namespace

std::string fitted(const std::string& lines, std::size_t columns)
{
    std::string text;
    for (std::size_t start = 0; start < lines.size();) {
        const std::size_t end = std::min(lines.find('\n', start), lines.size());
        text += fitted_line(lines.substr(start, end - start), columns);
        if (end < lines.size()) text += '\n';
        start = end + 1;
    }
    return text;
}

std::string styled(const std::string& lines, Style style, const TextLook& look)
{
    constexpr std::array<const char*, 4> codes{"", "\x1b[1m", "\x1b[1;32m", "\x1b[33m"};
    if (!look.has_style || style == Style::plain) return lines;
    std::string text;
    for (std::size_t start = 0; start < lines.size();) {
        const std::size_t end = std::min(lines.find('\n', start), lines.size());
        text +=
            codes[static_cast<std::size_t>(style)] + lines.substr(start, end - start) + "\x1b[0m\n";
        start = end + 1;
    }
    return text;
}

std::string paragraph(const std::string& text, const TextLook& look, Style style)
{
    return styled(wrapped(text, 2, look.columns), style, look);
}

void Legend::add(bool is_used, const std::string& mark_and_meaning)
{
    if (is_used) line_ += (line_.empty() ? "" : "; ") + mark_and_meaning;
}

std::string Legend::text(const TextLook& look) const
{
    return line_.empty() ? "" : wrapped(line_, 2, look.columns);
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

namespace {

std::string compact(std::string text)
{
    for (const auto& [wide, narrow] :
         {std::pair<std::string, std::string>{" ± ", "±"}, {" (", "("}, {" to ", "–"}})
        if (const std::size_t at = text.find(wide); at != text.npos)
            text.replace(at, wide.size(), narrow);
    return text;
}

bool has_error(const Interval& x)
{
    const double error = std::max(x.high - x.value, x.value - x.low);
    return x.value != 0 && std::isfinite(error) && error > 0;
}

struct Unit {
    double seconds;
    const char* name;
};

/// least: of the unit; what is less is given in the next smaller one.
Unit unit_of(double seconds, double least)
{
    if (seconds >= 36e5) return {86400, "d"};
    if (seconds >= 5995) return {3600, "h"};
    if (seconds >= 99.5) return {60, "m"};
    if (seconds >= least || seconds <= 0) return {1, "s"};
    if (seconds >= 1e-3 * least) return {1e-3, "ms"};
    return {1e-6, "µs"};
}

}  // namespace

std::string short_interval(const Interval& x)
{
    return has_error(x) ? compact(with_error(x)) : short_number(x.value);
}

std::string short_duration(double seconds)
{
    if (!std::isfinite(seconds)) return "";
    const Unit unit = unit_of(seconds, 0.0995);
    return fmt::format("{:.{}g}{}", seconds / unit.seconds, unit.seconds == 86400 ? 3 : 2,
                       unit.name);
}

std::string short_duration(const Interval& seconds)
{
    if (!has_error(seconds)) return short_duration(seconds.value);
    const Unit unit = unit_of(seconds.value, 1);  // 227±8ms, not 0.227±0.008s
    return short_interval({seconds.value / unit.seconds, seconds.low / unit.seconds,
                           seconds.high / unit.seconds}) +
           unit.name;
}

void TextTable::add_remark(const std::string& first, const std::string& second,
                           const std::string& remark)
{
    rows_.push_back({{first, second, remark}, true});
}

std::vector<std::size_t> TextTable::widths(std::size_t columns) const
{
    constexpr std::size_t least_name = 8;
    std::vector<std::size_t> widths(heads_.front().size(), 0);
    const auto widen = [&](const Cells& cells, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) widths[i] = std::max(widths[i], width_of(cells[i]));
    };
    for (const Cells& head : heads_) widen(head, head.size());
    for (const Row& row : rows_) widen(row.cells, row.is_remark ? 2 : row.cells.size());
    const auto others = [&] {  // with the blanks between
        std::size_t sum = widths[0] + 1;
        for (std::size_t i = 2; i < widths.size(); ++i)
            if (widths[i] > 0) sum += widths[i] + 1;
        return sum;
    };
    for (const std::size_t i : first_to_go_)
        if (i < widths.size() && others() + least_name > columns) widths[i] = 0;
    widths[1] = std::min(widths[1], std::max(columns, others() + least_name) - others());
    return widths;
}

std::string TextTable::line(const Cells& cells, const std::vector<std::size_t>& widths)
{
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const bool is_remark = i >= widths.size();
        if (!is_remark && widths[i] == 0 && i > 1) continue;
        if (i > 0) text += ' ';
        const std::size_t width = width_of(cells[i]),
                          space = !is_remark && width < widths[i] ? widths[i] - width : 0;
        if (i == 1 && width > widths[1])
            text += cells[i] + "\n" + std::string(widths[0] + 1 + widths[1], ' ');
        else
            text +=
                i == 1 ? cells[i] + std::string(space, ' ') : std::string(space, ' ') + cells[i];
    }
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
}

std::string TextTable::left_out(const std::vector<std::size_t>& widths) const
{
    std::string names;
    for (std::size_t i = 2; i < widths.size(); ++i) {
        if (widths[i] > 0 || std::ranges::find(first_to_go_, i) == first_to_go_.end()) continue;
        names += (names.empty() ? "" : ", ") + heads_.front()[i];
    }
    return names.empty() ? "" : "no room for: " + names;
}

std::string TextTable::text(const TextLook& look) const
{
    const std::vector<std::size_t> columns = widths(look.columns);
    std::size_t longest = 0;
    for (const Row& row : rows_)
        if (row.is_remark) longest = std::max(longest, width_of(row.cells[2]));
    const std::size_t room = look.columns - std::min(look.columns, columns[0] + 2 + longest);
    const std::vector<std::size_t> of_remark{columns[0], std::min(columns[1], room)};
    std::string text;
    for (const Cells& head : heads_) text += styled(line(head, columns), Style::bold, look);
    for (const Row& row : rows_) text += line(row.cells, row.is_remark ? of_remark : columns);
    const std::string missing = left_out(columns);
    return missing.empty() ? text : text + wrapped(missing, 2, look.columns);
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
