#pragma once

#include "mis/report/report.h"

#include <string>

namespace mis {

/// The report as `mis-report/1` (docs/report-format.md). Numbers keep all their digits; what is not
/// known or not finite is null. Ends with a line feed.
std::string report_json(const Report& report);

/// Writes it to the file `path`, whole or not at all; "-" is standard output. Throws WriteError.
void write_report_json(const Report& report, const std::string& path);

}  // namespace mis
