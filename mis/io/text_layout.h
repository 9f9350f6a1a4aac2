#pragma once

#include "mis/report/report.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mis {

/// How wide a terminal is taken to be that does not say it, and what is no terminal.
inline constexpr std::size_t text_columns = 80;

/// How text is laid out for who reads it.
struct TextLook {
    std::size_t columns = text_columns;
    bool has_style = false;   ///< bold and colour, by a terminal's codes
    bool is_verbose = false;  ///< with the reasons
};

enum class Style { plain, bold, answer, doubt };

/// Whole lines in a style, where the look has any.
std::string styled(const std::string& lines, Style style, const TextLook& look);

/// Places that UTF-8 `text` takes on a terminal, for the few signs that are printed here: one each.
std::size_t width_of(const std::string& text);

/// `text` with control characters as \u escapes: names in a file may hold some, which would play on
/// the terminal.
std::string printable(std::string_view text);

/// `text`, made printable, in lines of at most `columns`, all but the first indented, each ended by
/// a line feed. Longer words stay whole.
std::string wrapped(const std::string& text, std::size_t indent = 2,
                    std::size_t columns = text_columns);

/// Lines that are no longer than that, broken between words. What is broken goes on below the text
/// behind the blanks that part it from a name, as in a list of options, or below the line's first
/// word. Lines that a person would copy, commands behind four blanks, stay whole.
std::string fitted(const std::string& lines, std::size_t columns);

/// wrapped(), in the look and a style.
std::string paragraph(const std::string& text, const TextLook& look, Style style = Style::plain);

/// "~ undecided, = tied": a mark and what it means, of those that are in use; empty without any.
class Legend {
public:
    void add(bool is_used, const std::string& mark_and_meaning);
    std::string text(const TextLook& look) const;

private:
    std::string line_;
};

/// A number in at most six places where that can be: "0.0123", "1234", "1.2e-5"; "" if it is not
/// finite.
std::string short_number(double value);

/// As with_error() says it in sentences, without blanks: "0.0123±0.0003", "1.5(1.2–2.3)"; "0" where
/// exact, no error where none is known.
std::string short_interval(const Interval& x);

/// "0.83s", "12ms", "3.1m", "2.5h".
std::string short_duration(double seconds);

/// "830±20ms", "1.8(1.2–2.3)s".
std::string short_duration(const Interval& seconds);

/// A table of text: columns as wide as they must be, the second ("strategy") to the left, the
/// others to the right. If it is wider than the terminal, long cells of the second column stand on
/// a line of their own; then columns go, which the last line says.
class TextTable {
public:
    /// The heads of the columns, one or more lines. first_to_go: columns in the order in which they
    /// are left out where there is no room.
    explicit TextTable(std::vector<std::vector<std::string>> heads,
                       std::vector<std::size_t> first_to_go = {})
        : heads_(std::move(heads)), first_to_go_(std::move(first_to_go))
    {
    }
    void add(std::vector<std::string> row) { rows_.push_back({std::move(row), false}); }
    /// A row whose text runs on from the second column's end over all others.
    void add_remark(const std::string& first, const std::string& second, const std::string& remark);
    std::string text(const TextLook& look = {}) const;

private:
    using Cells = std::vector<std::string>;
    struct Row {
        Cells cells;
        bool is_remark;
    };
    /// As wide as a column's cells; 0 where it is left out.
    std::vector<std::size_t> widths(std::size_t columns) const;
    static std::string line(const Cells& cells, const std::vector<std::size_t>& widths);
    std::string left_out(const std::vector<std::size_t>& widths) const;

    std::vector<Cells> heads_;
    std::vector<std::size_t> first_to_go_;
    std::vector<Row> rows_;
};

/// " after … of reading and … of building trees"; empty where that is short.
std::string setup_text(const std::optional<SetupSeconds>& setup);

}  // namespace mis
