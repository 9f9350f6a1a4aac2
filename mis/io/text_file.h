#pragma once

#include "mis/math/stop_token.h"

#include <filesystem>
#include <string>
#include <string_view>

namespace mis {

/// The bytes of a file. Throws SceneError if it is missing, a directory, unreadable, empty, or
/// above limits::scene_file_bytes. `kind` names the file in the message: "scene", "table of
/// lights". Throws Stopped, as all readers here that take a token.
std::string read_text_file(const std::filesystem::path& file, std::string_view kind,
                           const StopToken& stop = {});

/// A place in a text, counted from 1, as editors show it; columns count bytes. A line ends by LF,
/// CR LF, or CR.
struct TextPlace {
    std::size_t line, column;
};
TextPlace place_in(std::string_view text, std::size_t byte);

/// Throws SceneError at the first byte of `text` that is not UTF-8, or that is a zero byte; what is
/// UTF-16, UTF-32 or packed is called so.
void require_utf8(std::string_view text, const std::filesystem::path& file,
                  const StopToken& stop = {});

/// `text` in quotes, safe to print: control characters and bytes that are not UTF-8 escaped, what
/// is long shortened.
std::string in_quotes(std::string_view text);

}  // namespace mis
