#pragma once

#include <string>
#include <vector>

namespace mis {

// Tables of comma-separated values (RFC 4180).

/// Quoted where needed, a quote doubled.
std::string csv_field(const std::string& text);

/// All digits; empty where the number is not finite.
std::string csv_field(double value);

/// A value as it stands in the file, and its column's name.
struct CsvCell {
    std::string column, value;
};
using CsvRow = std::vector<CsvCell>;

/// Adds a line of the columns' names or of the values, ended by CR LF.
void append_csv_line(std::string& text, const CsvRow& row, std::string CsvCell::*part);

}  // namespace mis
