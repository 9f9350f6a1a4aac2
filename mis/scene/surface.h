#pragma once

#include "mis/math/vec.h"

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

namespace mis {

/// Triangles in scene units, placed: the file's transform is already applied, in double.
struct Mesh {
    std::vector<Vec3<double>> positions;
    std::vector<Vec3<float>> normals;  ///< unit, one per position; empty where the file has none
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct SphereSurface {
    Vec3<double> center;
    double radius;
};

/// corner + u · edges[0] + v · edges[1] for u, v in [0, 1].
struct Quad {
    Vec3<double> corner;
    std::array<Vec3<double>, 2> edges;
};

/// Something that occludes and is shaded.
struct Surface {
    std::variant<Mesh, SphereSurface, Quad> shape;
    int material = 0;  ///< index into Scene::materials
};

}  // namespace mis
