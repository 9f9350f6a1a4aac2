#pragma once

#include <string>
#include <string_view>

namespace mis {

/// Bytes as base64 with padding (RFC 4648, §4), without line breaks.
std::string base64(std::string_view bytes);

}  // namespace mis
