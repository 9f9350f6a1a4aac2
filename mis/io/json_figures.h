#pragma once

#include "mis/compare/report.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace mis {

// How figures stand in all JSON that is written (docs/json-outputs.md).

/// null where it is not known or not finite.
inline nlohmann::ordered_json json_figure(double value)
{
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

inline nlohmann::ordered_json json_interval(const Interval& x)
{
    return {{"value", json_figure(x.value)},
            {"low", json_figure(x.low)},
            {"high", json_figure(x.high)}};
}

/// null where it is empty.
inline nlohmann::ordered_json text_or_null(const std::string& text)
{
    return text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
}

}  // namespace mis
