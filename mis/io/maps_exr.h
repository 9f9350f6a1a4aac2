#pragma once

#include "mis/report/maps.h"
#include "mis/report/report.h"

#include <string>

namespace mis {

/// Writes the maps of report.scenes[scene] as named layers (docs/report-format.md) to the file
/// `path`, whole or not at all. Throws WriteError.
void write_maps_exr(const Report& report, std::size_t scene, const Maps& maps,
                    const std::string& path);

}  // namespace mis
