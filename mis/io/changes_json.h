#pragma once

#include "mis/report/changes_report.h"

#include <string>

namespace mis {

/// What the JSON says of the comparison itself.
struct ChangesHeader {
    std::string version, command, file_before, file_after;
};

/// The changes as `mis-changes/1` (docs/json-outputs.md). Ends with a line feed.
std::string changes_json(const Changes& changes, const ChangesHeader& header);

/// The changes as a table: a header, then one row per scene and strategy (RFC 4180, as report_csv).
/// Columns: a figure x as x_before, x_after, x_ratio with its interval and x_verdict; the mean's
/// difference in standard errors as mean_difference.
std::string changes_csv(const Changes& changes);

}  // namespace mis
