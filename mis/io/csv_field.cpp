#include "mis/io/csv_field.h"

#include <fmt/format.h>

#include <cmath>

namespace mis {

std::string csv_field(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

std::string csv_field(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

void append_csv_line(std::string& text, const CsvRow& row, std::string CsvCell::*part)
{
    for (std::size_t i = 0; i < row.size(); ++i) text += (i > 0 ? "," : "") + row[i].*part;
    text += "\r\n";
}

}  // namespace mis
