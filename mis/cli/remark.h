#pragma once

#include "mis/cli/terminal.h"

#include <fmt/format.h>

#include <cstdio>
#include <utility>

namespace mis::cli {

/// Prints to standard error, where that is a terminal broken between words. A run whose remarks
/// cannot be written, as it is closed or the disk is full, goes on.
template <class... Values> void remark(fmt::format_string<Values...> format, Values&&... values)
{
    std::fputs(for_errors(fmt::format(format, std::forward<Values>(values)...)).c_str(), stderr);
}

}  // namespace mis::cli
