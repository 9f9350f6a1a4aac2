#pragma once

#include "mis/math/stop_token.h"
#include "mis/scene/light.h"

#include <filesystem>
#include <string_view>

namespace mis {

/// Appends the lights of a table: comma-separated, the first line naming the columns x, y, z,
/// radius, r, g, b in any order; r, g, b is the radiance. A byte order mark, CRLF and empty lines
/// at the end are allowed. Throws SceneError as `bulbs.csv: line 7, column radius: found "abc"; …`,
/// or, with an empty pointer, about the file; and Stopped.
void append_light_table(const std::filesystem::path& file, Lights& to, const StopToken& stop = {});

/// The same of a text at hand; `file` is for messages.
void append_light_table(std::string_view text, const std::filesystem::path& file, Lights& to,
                        const StopToken& stop = {});

}  // namespace mis
