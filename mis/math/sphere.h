#pragma once

#include "mis/math/stable.h"

#include <limits>

namespace mis {

/// Distance along the unit direction wi to the near side of a sphere whose centre lies at
/// `to_center`, or infinity where the ray misses it, the sphere lies behind, or the origin is
/// inside. The impact parameter q = |to_center × wi| decides: B² − C of the textbook cancels at d/r
/// = 1e3 in float. The distance is (d² − r²)/(to_center·wi + √(r² − q²)), which does not cancel
/// near the surface either. docs/theory.md, eq. 6. Accuracy: 1e-5 of the distance in float at d/r =
/// 1e5 (sphere_test.cpp).
template <class T>
MIS_INLINE T hit_distance(const Vec3<T>& to_center, const T& radius, const Vec3<T>& wi)
{
    using std::sqrt;
    const T along = dot(to_center, wi);
    const T q = length(cross(to_center, wi));
    const T d = length(to_center);
    const T half_chord2 = (radius - q) * (radius + q);
    const T distance =
        (d - radius) * (d + radius) / (along + sqrt(max_of(half_chord2, number<T>(0))));
    const T miss = number<T>(std::numeric_limits<double>::infinity());
    return select(q <= radius,
                  select(along > number<T>(0), select(d > radius, distance, miss), miss), miss);
}

/// Does a ray along the unit direction wi meet that sphere? The question hit_distance answers
/// first, without a root.
template <class T>
MIS_INLINE auto meets_sphere(const Vec3<T>& to_center, const T& radius, const Vec3<T>& wi)
{
    const auto is_near = length2(cross(to_center, wi)) <= radius * radius;
    const auto is_ahead = dot(to_center, wi) > number<T>(0);
    return is_near & is_ahead;
}

}  // namespace mis
