#include "mis/io/scene_error.h"

#include "mis/io/text_layout.h"

#include <fmt/format.h>

namespace mis {

SceneError::SceneError(std::string_view file, const Problem& p)
    : std::runtime_error(fmt::format(
          "{}{}{}: found {}; {}\n    {}", printable(file), p.pointer.empty() ? "" : ": ",
          printable(p.pointer), printable(p.found), printable(p.allowed), printable(p.remedy))),
      problem(p)
{
}

}  // namespace mis
