#pragma once

#include "mis/io/json_node.h"

#include <filesystem>

namespace mis {

/// The file that a member "file" of a scene names, relative to the folder of the scene. Throws
/// SceneError at the member unless it is a file that exists.
std::filesystem::path referenced_file(const JsonNode& name);

/// One of `known`, the value of a member "type". Throws SceneError otherwise, with the nearest
/// known name.
std::string_view read_type(const JsonNode& type, std::span<const std::string_view> known);

}  // namespace mis
