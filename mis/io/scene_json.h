#pragma once

#include "mis/io/scene_error.h"
#include "mis/math/stop_token.h"
#include "mis/scene/scene.h"

#include <filesystem>
#include <string_view>

namespace mis {

/// The scene of a file in the format of docs/scene-format.md, with its meshes and tables. It keeps
/// every rule of scene/validate. Throws SceneError at the first thing that is wrong, and Stopped.
Scene read_scene(const std::filesystem::path& file, const StopToken& stop = {});

/// The same of a text at hand; `file` is for messages, and its folder for the files that the scene
/// names.
Scene parse_scene(std::string_view text, const std::filesystem::path& file,
                  const StopToken& stop = {});

}  // namespace mis
