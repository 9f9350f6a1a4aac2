#pragma once

#include <filesystem>

namespace mis {

/// Throws SceneError, with an empty pointer, unless the file starts with a well-formed PLY header
/// whose counts can be those of a file of its size, and a body that is long enough for them. Assimp
/// 5.2 never returns from some headers that are not, and takes what is missing of a body for 0.
void require_ply_header(const std::filesystem::path& file);

}  // namespace mis
