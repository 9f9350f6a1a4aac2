#pragma once

#include "mis/report/report.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace mis {

// What the JSON of reports is made of.

using OrderedJson = nlohmann::ordered_json;

/// null where it is not finite.
OrderedJson json_figure(double value);

/// null where it is empty.
OrderedJson json_text_or_null(const std::string& text);

OrderedJson json_interval(const Interval& x);

/// [width, height] in pixels; null without a camera.
OrderedJson json_resolution(int width, int height);

/// "setup_seconds", where they are known.
void put_setup(OrderedJson& json, const std::optional<SetupSeconds>& setup);

/// A strategy, as data; "counts" are draws per sample, light and BSDF.
OrderedJson json_identity(const Strategy& s);

/// What the report of a run begins with.
OrderedJson json_head(std::string_view format, const RunHead& run);

/// Indented, with a line feed at the end. A command line or a file name may hold bytes that are not
/// UTF-8; JSON cannot.
std::string json_text(const OrderedJson& json);

}  // namespace mis
