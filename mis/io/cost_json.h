#pragma once

#include "mis/report/cost_report.h"

#include <string>

namespace mis {

/// As `mis-cost/1`, the outer shape of `mis-report/1` (docs/json-outputs.md, cost.schema.json).
/// Numbers keep all their digits; what is not known or not finite is null. Ends with a line feed.
std::string cost_json(const CostReport& report);

/// As a table: a header, then one row per measured point and per time to an error, lines ended by
/// CR LF (RFC 4180). What is not known or not finite is empty.
std::string cost_csv(const CostReport& report);

}  // namespace mis
