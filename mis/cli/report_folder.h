#pragma once

#include "mis/report/report.h"
#include "mis/study/maps.h"

#include <optional>
#include <span>
#include <string>

namespace mis::cli {

/// Throws UsageError where the folder stands already and `force` is not given, or where it cannot
/// be made.
void check_report_folder(const std::string& folder, bool force);

/// Writes report.json, strategies.csv, report.html and, for each scene with a camera, maps.exr
/// (maps-1.exr, maps-2.exr … if there are several scenes) into the folder, made if need be. Maps
/// that an earlier report left there go. maps: one per scene, but for those without a camera.
/// Throws WriteError.
void write_report_folder(const Report& report, std::span<const std::optional<Maps>> maps,
                         const std::string& folder, bool force);

}  // namespace mis::cli
