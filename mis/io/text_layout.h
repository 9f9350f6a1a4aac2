#pragma once

#include "mis/report/report.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mis {

/// How wide a terminal is taken to be.
inline constexpr std::size_t text_columns = 80;

/// Places that UTF-8 `text` takes on a terminal, for the few signs that are printed here: one each.
std::size_t width_of(const std::string& text);

/// `text` with control characters as \u escapes: names in a file may hold some, which would play on
/// the terminal.
std::string printable(std::string_view text);

/// `text`, made printable, in lines of at most `columns`, all but the first indented, each ended by
/// a line feed. Longer words stay whole.
std::string wrapped(const std::string& text, std::size_t indent = 2,
                    std::size_t columns = text_columns);

/// A number in at most six places where that can be: "0.0123", "1234", "1.2e-5"; "" if it is not
/// finite.
std::string short_number(double value);

/// "0.0123 ±2%": the larger half of the interval, rounded up to a percent; "0" where exact, no
/// error where none is known; its ends, "690-250000", where the half is more than half the value.
std::string short_interval(const Interval& x);

/// "0.83s", "12ms", "3.1m", "2.5h".
std::string short_duration(double seconds);

/// "1 light", "5 lights".
std::string many(std::size_t count, std::string_view what);

/// A table of text: columns as wide as they must be, the second ("strategy") to the left, the
/// others to the right. If it is wider than the terminal, long cells of the second column stand on
/// a line of their own.
class TextTable {
public:
    /// The heads of the columns, one or more lines.
    explicit TextTable(std::vector<std::vector<std::string>> heads) : heads_(std::move(heads)) {}
    void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
    /// A row whose text runs on from the second column's end over all others.
    void add_remark(const std::string& first, const std::string& second, const std::string& remark);
    std::string text() const;

private:
    std::vector<std::size_t> widths() const;
    static std::string line(const std::vector<std::string>& cells,
                            const std::vector<std::size_t>& widths);

    std::vector<std::vector<std::string>> heads_, rows_;  ///< a row of three cells is a remark
};

/// " after … of reading and … of building trees"; empty where that is short.
std::string setup_text(const std::optional<SetupSeconds>& setup);

}  // namespace mis
