#pragma once

#include "mis/report/report.h"

#include <string>

namespace mis {

/// The report as a table: a header, then one row per scene and strategy, quoted as RFC 4180 says,
/// lines ended by CR LF. The columns are those of `mis-report/1`, an interval as x, x_low and
/// x_high; what is not known or not finite is empty.
std::string report_csv(const Report& report);

/// Writes it to the file `path`, whole or not at all; "-" is standard output. Throws WriteError.
void write_report_csv(const Report& report, const std::string& path);

}  // namespace mis
