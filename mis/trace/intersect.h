#pragma once

#include "mis/math/vec.h"
#include "mis/scene/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {

// Where does a ray meet one surface? In double, closed form; distances are along the unit
// direction, infinity is a miss.

inline constexpr double no_hit = std::numeric_limits<double>::infinity();

/// A point of a triangle or parallelogram: corner + u·e1 + v·e2.
struct PlaneHit {
    double distance = no_hit, u = 0, v = 0;
};

/// The plane of corner, e1 and e2. Source: Möller and Trumbore 1997.
inline PlaneHit hit_plane(const Vec3<double>& origin, const Vec3<double>& direction,
                          const Vec3<double>& corner, const Vec3<double>& e1,
                          const Vec3<double>& e2)
{
    const Vec3<double> p = cross(direction, e2);
    const double determinant = dot(e1, p);
    if (determinant == 0) return {};
    const Vec3<double> s = origin - corner;
    const Vec3<double> q = cross(s, e1);
    return {dot(e2, q) / determinant, dot(s, p) / determinant, dot(direction, q) / determinant};
}

inline PlaneHit hit_triangle(const Vec3<double>& origin, const Vec3<double>& direction,
                             const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c)
{
    const PlaneHit hit = hit_plane(origin, direction, a, b - a, c - a);
    const bool inside = hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1;
    return inside && hit.distance > 0 ? hit : PlaneHit{};
}

inline PlaneHit hit_quad(const Vec3<double>& origin, const Vec3<double>& direction,
                         const Quad& quad)
{
    const PlaneHit hit = hit_plane(origin, direction, quad.corner, quad.edges[0], quad.edges[1]);
    const bool inside = hit.u >= 0 && hit.v >= 0 && hit.u <= 1 && hit.v <= 1;
    return inside && hit.distance > 0 ? hit : PlaneHit{};
}

/// The nearer side of a sphere in front of the origin, which may be inside. The two distances have
/// the product d² − r² and half-sum `along`, so the one that cancels is had from the other.
inline double hit_sphere(const Vec3<double>& origin, const Vec3<double>& direction,
                         const Vec3<double>& center, double radius)
{
    const Vec3<double> to_center = center - origin;
    const double along = dot(to_center, direction), q = length(cross(to_center, direction));
    if (q > radius) return no_hit;
    const double half_chord = std::sqrt((radius - q) * (radius + q));
    const double d = length(to_center), product = (d - radius) * (d + radius);
    const double far = along >= 0 ? along + half_chord : product / (along - half_chord);
    if (!(far > 0)) return no_hit;  // behind; or it begins at the sphere and grazes it
    const double near = along >= 0 ? product / far : along - half_chord;
    return near > 0 ? near : far;
}

/// Room for the rounding of float coordinates up to `largest`: of the ray's origin and of the
/// surface itself.
inline double float_offset(double largest) { return largest * 0x1p-20; }

inline double largest_coordinate(const Vec3<double>& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

}  // namespace mis
