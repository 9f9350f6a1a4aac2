#pragma once

#include "mis/io/transform.h"
#include "mis/scene/surface.h"

#include <filesystem>

namespace mis {

/// The triangles of an OBJ or PLY file, placed by `transform`. Polygons are cut into triangles,
/// triangles without an area dropped, equal vertices merged; points and lines are left out. Smooth
/// normals where the file has them: a vertex without one has the normal of its triangle, and a file
/// without any gives an empty list. Accuracy: Assimp keeps a file's coordinates as floats (7
/// digits); all that follows is double. Throws SceneError, with an empty pointer, for a file that
/// is missing or no mesh, and for a mesh without triangles.
Mesh read_mesh(const std::filesystem::path& file, const Transform& transform = {});

}  // namespace mis
