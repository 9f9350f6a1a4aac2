#pragma once

#include "mis/compare/report.h"

#include <string>

namespace mis::cli {

/// Throws UsageError where the folder stands already and `force` is not given, or where it cannot
/// be made.
void check_report_folder(const std::string& folder, bool force);

/// Writes report.json and strategies.csv into the folder, made if need be. Throws WriteError.
void write_report_folder(const Report& report, const std::string& folder, bool force);

}  // namespace mis::cli
