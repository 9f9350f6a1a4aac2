#pragma once

#include "mis/math/stop_token.h"
#include "mis/math/vec.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace mis {

/// Corners of one triangle, as indices into the polygon.
using PolygonTriangle = std::array<std::size_t, 3>;

/// Normal times twice the area of a triangle, and 0 where that lies within the rounding of its
/// coordinates: three decimal numbers on a line are rarely on it in binary.
Vec3<double> area_vector(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c);

/// Cuts a polygon into triangles of its own orientation that cover it once; it need not be convex
/// or quite plane (it is seen along its mean normal), it may touch itself, and reach its holes by
/// bridges. Corners that are repeated or lie on the line of their neighbours stay where that can
/// be. A polygon without an area gives no triangles. False for one that crosses itself by more than
/// 1e-6 of its coordinates. Throws Stopped. Source: ear clipping, Meisters 1975; the mean normal is
/// Newell's (Sutherland et al. 1974).
bool triangulate(std::span<const Vec3<double>> polygon, std::vector<PolygonTriangle>& triangles,
                 const StopToken& stop = {});

}  // namespace mis
