#pragma once

#include "mis/math/stop_token.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace mis {

/// What a file is that is not UTF-8, by its first bytes: "UTF-16 text (little-endian)", "a gzip
/// file", …; empty where they do not say.
std::string_view other_encoding(std::string_view text);

/// Bytes of the UTF-8 character at the start of `rest`; 0 if there is none (RFC 3629: no overlong
/// forms, no surrogates).
std::size_t utf8_length(std::string_view rest);

/// Where the first byte of `text` is that is no UTF-8, or a zero byte; its size where none is.
std::size_t first_not_utf8(std::string_view text, const StopToken& stop = {});

/// "U+00A0, a no-break space", for a character of UTF-8 at the start of `rest`; the name is left
/// out where it is not one that is known to get into files unseen.
std::string described_character(std::string_view rest);

}  // namespace mis
