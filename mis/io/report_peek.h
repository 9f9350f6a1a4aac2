#pragma once

#include <filesystem>

namespace mis {

/// Is this a report, by the "format" near its start? No more is read. False for what is no ordinary
/// file: a pipe can be read only once.
bool is_report_file(const std::filesystem::path& file);

}  // namespace mis
