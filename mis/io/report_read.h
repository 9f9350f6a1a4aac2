#pragma once

#include "mis/math/stop_token.h"
#include "mis/report/report.h"

#include <filesystem>
#include <string_view>

namespace mis {

/// The report in a file that report_json wrote (`mis-report/1`, docs/report-format.md): report_json
/// of it is that file again. null is NaN: not known. Keys that are not known are passed over, as
/// later versions may add some; sentences are not read, as they follow from the figures. Throws
/// SceneError and Stopped.
Report read_report(const std::filesystem::path& file, const StopToken& stop = {});

/// The same of a text. `file` is for messages.
Report parse_report(std::string_view text, const std::filesystem::path& file,
                    const StopToken& stop = {});

}  // namespace mis
