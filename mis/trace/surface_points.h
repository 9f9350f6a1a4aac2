#pragma once

#include "mis/scene/scene.h"
#include "mis/trace/visibility.h"

#include <cstdint>
#include <optional>
#include <span>

namespace mis {

/// Where on a scene's surfaces: which one, and which triangle of a mesh.
struct SurfaceLocation {
    std::size_t surface = 0;
    std::uint32_t triangle = 0;
};

/// The hit of a ray with the surface at `location`, in double, with both normals turned to the
/// ray's origin, each for itself. Nothing where the ray misses its plane or sphere altogether;
/// beyond an edge, by rounding, the plane counts. frame_origin: SurfaceTracer::origin().
std::optional<SurfaceHit> hit_at(const Scene& scene, const SurfaceLocation& location,
                                 const Vec3<double>& origin, const Vec3<double>& direction,
                                 const Vec3<double>& frame_origin);

/// SurfaceHit::offset of the surface that x lies on, to rounding, or of the point itself where it
/// lies on none.
double offset_of_point(const Scene& scene, const Vec3<double>& x, const Vec3<double>& frame_origin);

/// The same of many points, by one pass over the surfaces: offsets[i] of points[i].
void offsets_of_points(const Scene& scene, std::span<const Vec3<double>> points,
                       const Vec3<double>& frame_origin, const ForEach& for_each,
                       std::span<double> offsets);

/// Where floats are best measured from: what the camera looks at, or the first probe.
Vec3<double> frame_origin_of(const Scene& scene);

}  // namespace mis
