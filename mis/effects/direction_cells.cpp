#include "mis/effects/direction_cells.h"

namespace mis {

namespace {

/// The direction at a place of the square [−1, 1]².
Vec3<double> direction_at(double u, double v)
{
    const double z = 1 - std::abs(u) - std::abs(v);
    if (z >= 0) return normalized(Vec3<double>(u, v, z));
    return normalized(
        Vec3<double>(std::copysign(1 - std::abs(v), u), std::copysign(1 - std::abs(u), v), z));
}

/// Cells are flat on the octahedron, or two triangles: seen from its middle their sides are parts
/// of great circles, so no point is further from the axis than a corner.
DirectionCells::Cone cone_around(std::size_t cell)
{
    constexpr double step = 2.0 / DirectionCells::side;
    const double u = step * static_cast<double>(cell % DirectionCells::side) - 1,
                 v = step * static_cast<double>(cell / DirectionCells::side) - 1;
    const std::array corners{direction_at(u, v), direction_at(u + step, v),
                             direction_at(u, v + step), direction_at(u + step, v + step)};
    const Vec3<double> axis = normalized(corners[0] + corners[1] + corners[2] + corners[3]);
    double sine = 0;
    for (const Vec3<double>& corner : corners) sine = std::max(sine, length(cross(axis, corner)));
    return {axis, sine + 1e-5};
}

}  // namespace

const std::array<DirectionCells::Cone, DirectionCells::count>& DirectionCells::cones()
{
    static const auto all = [] {
        std::array<Cone, count> cones;
        for (std::size_t cell = 0; cell < count; ++cell) cones[cell] = cone_around(cell);
        return cones;
    }();
    return all;
}

}  // namespace mis
