#pragma once

#include "mis/scene/validate.h"

#include <stdexcept>
#include <string>
#include <string_view>

namespace mis {

/// A scene that cannot be used. what() is the finished message, safe to print; `problem` is for
/// programs. `problem.pointer` is a JSON pointer; for a text that is no JSON, for a table of
/// lights and for a mesh, it is a line and a column, or a row; it is empty where the file as a
/// whole is meant.
struct SceneError : std::runtime_error {
    SceneError(std::string_view file, const Problem& p);
    Problem problem;
};

}  // namespace mis
