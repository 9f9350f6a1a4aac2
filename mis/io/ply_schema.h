#pragma once

#include "mis/io/ply_header.h"

#include <cstddef>
#include <filesystem>

namespace mis {

/// What a property of an element is read as: one of a vertex's numbers x, y, z, nx, ny, nz (0 to
/// 5), the list of a face or strip, or nothing.
namespace ply_role {
inline constexpr int ignored = -1, list = 6;
}
int role_of(const PlyElement& element, const PlyProperty& property);

bool has_vertex_normals(const PlyElement& vertex);

/// Throws SceneError unless a mesh can be read by the header: its elements have the properties they
/// need, each of its kind, and the `there` bytes of the body can hold them all.
void require_mesh_header(const PlyHeader& header, std::size_t there,
                         const std::filesystem::path& file);

}  // namespace mis
