#include "mis/io/table_csv.h"

#include "mis/io/encoding.h"
#include "mis/io/number_text.h"
#include "mis/io/scene_error.h"
#include "mis/io/scene_keys.h"
#include "mis/io/text_file.h"
#include "mis/scene/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace mis {
namespace {

constexpr std::size_t column_count = scene_keys::columns.size();

std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == text.npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Takes what stands before the next separator off the front of `rest`.
std::string_view take_until(char separator, std::string_view& rest)
{
    const std::size_t end = std::min(rest.find(separator), rest.size());
    const std::string_view taken = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return taken;
}

/// What else tables are separated by, if the text has any: "semicolons", …; or nothing.
std::string_view other_separator(std::string_view text)
{
    if (text.find(';') != text.npos) return "semicolons";
    if (text.find('\t') != text.npos) return "tabs";
    return text.find('|') != text.npos ? "bars" : "";
}

bool is_quoted(std::string_view field) { return field.find_first_of("\"'") != field.npos; }

/// A field in quotes, and the first character of it that is not ASCII and may not be seen.
std::string shown_field(std::string_view field)
{
    const auto strange = std::find_if(field.begin(), field.end(),
                                      [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
    if (strange == field.end()) return in_quotes(field);
    return in_quotes(field) + ", which has in it " +
           described_character(field.substr(static_cast<std::size_t>(strange - field.begin())));
}

using Fields = std::array<std::string_view, column_count>;

/// The number of fields of a row; those that fit go to `fields`.
std::size_t split(std::string_view row, Fields& fields, StopEvery& check)
{
    for (std::size_t count = 1;; ++count) {
        check();
        const std::size_t end = row.find(',');
        if (count <= fields.size()) fields[count - 1] = row.substr(0, end);
        if (end == row.npos) return count;
        row.remove_prefix(end + 1);
    }
}

/// Reads one table, line by line.
class TableReader {
public:
    TableReader(std::string_view text, const std::filesystem::path& file, const StopToken& stop)
        : rest_(text), file_(file), check_(stop, 1 << 14)
    {
        constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
        if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
        while (!rest_.empty() &&
               std::string_view(" \t\r\n").find(rest_.back()) != std::string_view::npos) {
            rest_.remove_suffix(1);
            check_();
        }
    }

    void append_to(Lights& lights)
    {
        require_line_feeds();
        read_header();
        if (rest_.empty())
            fail("", "a header and no rows", "a table has at least one light", "Add a row.");
        lights.reserve(lights.size() +
                       static_cast<std::size_t>(std::count(rest_.begin(), rest_.end(), '\n')) + 1);
        while (!rest_.empty()) {
            if (lights.size() >= limits::lights)
                fail("", "one more light than a scene may have",
                     fmt::format("a scene has at most {} lights", limits::lights),
                     "Split the table.");
            lights.push_back(read_light());
        }
    }

private:
    [[noreturn]] void fail(std::string_view column, std::string found, std::string allowed,
                           std::string remedy) const
    {
        const std::string place =
            column.empty() ? fmt::format("line {}", line_)
                           : fmt::format("line {}, column{} {}", line_,
                                         column.find(',') == column.npos ? "" : "s", column);
        throw SceneError(file_.string(),
                         Problem{place, std::move(found), std::move(allowed), std::move(remedy)});
    }

    std::string_view next_line()
    {
        ++line_;
        return take_until('\n', rest_);
    }

    /// Old Macs' line ends would make one line of the table, or blanks of them.
    void require_line_feeds()
    {
        for (std::size_t at = 0; (at = rest_.find('\r', at)) != rest_.npos; ++at) {
            check_();
            if (rest_.substr(at + 1).starts_with('\n')) continue;
            line_ = 1 + static_cast<std::size_t>(std::count(
                            rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
            fail("", "a carriage return (CR) that ends the line", "a line ends in LF or CR LF",
                 "Save the table with the line ends of Unix or Windows.");
        }
    }

    /// What is no name of a column at all.
    void check_header(std::string_view header, const std::string& allowed) const
    {
        if (is_quoted(header))
            fail("", "a header in quotes: " + in_quotes(header), allowed + ", without quotes",
                 "Remove the quotes; in R: write.csv(..., quote = FALSE, row.names = FALSE).");
        if (header.find(',') == header.npos) {
            const std::string_view separator = other_separator(header);
            fail("",
                 "the header " + in_quotes(header) +
                     (separator.empty() ? "" : ", separated by " + std::string(separator)),
                 allowed, "Separate the columns by commas, and write 0.5, not 0,5.");
        }
        double number = 0;
        if (!read_number_text(trimmed(header.substr(0, header.find(','))), number))
            fail("", "numbers where the header belongs", allowed,
                 "Begin with the line x,y,z,radius,r,g,b.");
    }

    void read_header()
    {
        std::string_view header = trimmed(next_line());
        const std::string allowed =
            "the columns are " + comma_list(scene_keys::columns) + ", in any order";
        check_header(header, allowed);
        std::array<bool, column_count> seen{};
        for (bool more = true; more;) {
            more = header.find(',') != header.npos;
            const std::string_view name = trimmed(take_until(',', header));
            const auto column =
                std::find(scene_keys::columns.begin(), scene_keys::columns.end(), name);
            if (name.empty())
                fail("", fmt::format("no name for column {}", order_.size() + 1), allowed,
                     "Remove the column: row names, in R by row.names = FALSE, in pandas by "
                     "index=False.");
            if (column == scene_keys::columns.end())
                fail("", "the unknown column " + shown_field(name), allowed,
                     did_you_mean(name, scene_keys::columns, "Remove it."));
            const auto index = static_cast<std::size_t>(column - scene_keys::columns.begin());
            if (seen[index])
                fail("", "the column " + in_quotes(name) + " a second time", allowed,
                     "Remove one of the two.");
            seen[index] = true;
            order_.push_back(index);
        }
        for (std::size_t i = 0; i < column_count; ++i)
            if (!seen[i])
                fail("", fmt::format("no column \"{}\"", scene_keys::columns[i]), allowed,
                     "Add it.");
    }

    double read_number(std::string_view field, std::string_view column) const
    {
        const std::string_view text = trimmed(field);
        double number = 0;
        if (const std::optional<NumberProblem> problem = read_number_text(text, number))
            fail(column, shown_field(text), problem->allowed,
                 is_quoted(text) ? "Write it without quotes." : problem->remedy);
        return number;
    }

    Light read_light()
    {
        check_();
        const std::string_view row = next_line();
        Fields fields;
        const std::size_t count = split(row, fields, check_);
        if (count != column_count) {
            const std::string_view separator = other_separator(trimmed(row));
            fail("",
                 trimmed(row).empty()
                     ? "an empty line"
                     : fmt::format("{} {}{}", count, count == 1 ? "field" : "fields",
                                   separator.empty() ? "" : " and " + std::string(separator)),
                 fmt::format("a row has {} fields, as the header has", column_count),
                 count > column_count && separator.empty()
                     ? "Mend or remove the line; a number is written 0.5, not 0,5, and rows have "
                       "no names."
                 : separator.empty() ? "Mend or remove the line."
                                     : "Separate the fields by commas, and write 0.5, not 0,5.");
        }
        std::array<double, column_count> values;
        for (std::size_t i = 0; i < column_count; ++i)
            values[order_[i]] = read_number(fields[i], scene_keys::columns[order_[i]]);
        const auto& [x, y, z, radius, r, g, b] = values;
        if (const std::optional<Problem> problem =
                find_light_problem({x, y, z}, radius, Emission::radiance, {r, g, b})) {
            const std::string_view column = problem->pointer == "/radius"   ? "radius"
                                            : problem->pointer == "/center" ? "x, y, z"
                                                                            : "r, g, b";
            fail(column, problem->found, problem->allowed, problem->remedy);
        }
        return make_light({x, y, z}, radius, {r, g, b});
    }

    std::string_view rest_;
    const std::filesystem::path& file_;
    StopEvery check_;
    std::size_t line_ = 0;
    std::vector<std::size_t>
        order_;  ///< of the columns in the file, as indices into scene_keys::columns
};

}  // namespace

void append_light_table(std::string_view text, const std::filesystem::path& file, Lights& to,
                        const StopToken& stop)
{
    require_utf8(text, file, stop);
    TableReader(text, file, stop).append_to(to);
}

void append_light_table(const std::filesystem::path& file, Lights& to, const StopToken& stop)
{
    append_light_table(read_text_file(file, "table of lights", stop), file, to, stop);
}

}  // namespace mis
