#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace mis {

/// RFC 4180: quoted where needed, a quote doubled.
inline std::string csv_field(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + '"';
}

/// Empty where it is not finite.
inline std::string csv_field(double value)
{
    return std::isfinite(value) ? fmt::format("{}", value) : "";
}

}  // namespace mis
