#pragma once

#include "mis/io/byte_source.h"
#include "mis/io/mesh_builder.h"

#include <filesystem>

namespace mis {

/// Adds the faces of an OBJ file. Lines and points are left out, colours, texture coordinates,
/// groups and materials ignored. Throws SceneError with line and column for what is no OBJ
/// statement, for a number that is none, and for curved surfaces; `file` is for messages.
/// Source: Wavefront, "Object Files (.obj)", Advanced Visualizer manual, appendix B1.
void read_obj(ByteSource& source, const std::filesystem::path& file, MeshBuilder& mesh);

}  // namespace mis
