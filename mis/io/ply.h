#pragma once

#include "mis/io/byte_source.h"
#include "mis/io/mesh_builder.h"

#include <filesystem>

namespace mis {

/// Adds the faces and triangle strips of a PLY file, in text or binary of either endian. Elements
/// and properties that are not known are left out. Throws SceneError, with line and column in a
/// text, row and byte in a binary body; `file` is for messages.
void read_ply(ByteSource& source, const std::filesystem::path& file, MeshBuilder& mesh);

}  // namespace mis
