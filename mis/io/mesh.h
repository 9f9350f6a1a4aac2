#pragma once

#include "mis/io/transform.h"
#include "mis/math/stop_token.h"
#include "mis/scene/surface.h"

#include <filesystem>
#include <string_view>

namespace mis {

/// The triangles of an OBJ or PLY file, placed by `transform`. Polygons are cut into triangles,
/// triangles without an area dropped, equal vertices merged; points and lines are left out. Smooth
/// normals where the file has them: a vertex without one has the normal of its triangle, and a file
/// without any gives an empty list. Coordinates are doubles throughout. Throws SceneError for a
/// file that is missing or no mesh, and for a mesh without triangles: with line and column as the
/// pointer, or the row of a binary PLY, where it has a place. Throws Stopped, too.
Mesh read_mesh(const std::filesystem::path& file, const Transform& transform = {},
               const StopToken& stop = {});

/// The same of bytes at hand; `file` is for its extension and for messages.
Mesh parse_mesh(std::string_view bytes, const std::filesystem::path& file,
                const Transform& transform = {});

}  // namespace mis
