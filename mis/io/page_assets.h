#pragma once

#include <string_view>

namespace mis {

/// A file that the build put into the program: one of mis/io/report_html/, or "d3.min.js". Empty
/// for any other name.
std::string_view page_asset(std::string_view name);

}  // namespace mis
