#pragma once

#include "mis/math/irradiance.h"
#include "mis/math/root.h"
#include "mis/policy/light_choice.h"

#include <cmath>
#include <cstddef>

namespace mis {

/// One light of the columns as seen from a point, or a batch of them.
template <class T> struct SeenLight {
    Vec3<T> to_center;   ///< from the point, scene units
    T distance2;         ///< to the centre, squared
    T radius;            ///< scene units
    T luminance_radius;  ///< Y(L)·r
    T size;  ///< radius over the largest radius of the scene: its square stays a normal number

    /// To the centre, scene units. A point that rounding puts into the light is on it.
    MIS_INLINE T distance() const
    {
        using std::sqrt;
        return max_of(T(sqrt(distance2)), radius);
    }

    /// 1/distance().
    MIS_INLINE T inverse_distance() const { return number<T>(1) / distance(); }

    /// Ω/(2π r) = r/(d² + d √(d² − r²)): times another factor of r it is the solid angle; apart
    /// from it, it does not underflow.
    MIS_INLINE T solid_angle_over_radius() const
    {
        const T r2 = radius * radius,
                d2 = min_of(max_of(distance2, max_of(r2, number<T>(1e-37))), number<T>(1e38));
        return radius / (d2 + root_of_product(d2, T(d2 - r2)));
    }

    /// Its cap over the surface of normal n.
    MIS_INLINE TiltedCap<T> tilted_cap(const Vec3<T>& n) const
    {
        using std::sqrt;
        const T d = distance(), inverse = inverse_distance();
        return {radius * inverse, sqrt((d - radius) * (d + radius)) * inverse,
                dot(n, to_center) * inverse, length(cross(n, to_center)) * inverse};
    }
};

/// A vector in every lane.
template <class T> MIS_INLINE Vec3<T> in_lanes(const Vec3<Scalar<T>>& v)
{
    return {T(v.x), T(v.y), T(v.z)};
}

/// Lights [first, first + lane_count) of the columns.
template <class T>
MIS_INLINE SeenLight<T> seen_light(const LightColumns<Scalar<T>>& lights, std::size_t first,
                                   const Vec3<T>& x)
{
    const Vec3<T> to_center =
        Vec3<T>{load_lanes<T>(&lights.x[first]), load_lanes<T>(&lights.y[first]),
                load_lanes<T>(&lights.z[first])} -
        x;
    const T radius = load_lanes<T>(&lights.radius[first]);
    return {to_center, dot(to_center, to_center), radius,
            load_lanes<T>(&lights.luminance_radius[first]),
            radius * T(lights.inverse_largest_radius)};
}

}  // namespace mis
