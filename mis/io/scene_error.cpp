#include "mis/io/scene_error.h"

#include <fmt/format.h>

namespace mis {
namespace {

/// Names in a file may hold control characters, which would play on the terminal.
std::string printable(std::string_view text)
{
    std::string safe;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7F) safe += fmt::format("\\u{:04x}", byte);
        else safe += c;
    }
    return safe;
}

}  // namespace

SceneError::SceneError(std::string_view file, const Problem& p)
    : std::runtime_error(fmt::format(
          "{}{}{}: found {}; {}\n    {}", printable(file), p.pointer.empty() ? "" : ": ",
          printable(p.pointer), printable(p.found), printable(p.allowed), printable(p.remedy))),
      problem(p)
{
}

}  // namespace mis
