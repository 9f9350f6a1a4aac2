#pragma once

#include "mis/math/frame.h"

namespace mis {

/// The directions from a point into a sphere: a cone about `axis` of half-angle θ_max.
/// Nothing here is a difference of nearly equal numbers, and no square of the radius is formed: a
/// cap of 1e-20 rad is as exact as one of 1 rad (docs/theory.md §2).
template <class T> struct Cap {
    Vec3<T> axis;            ///< unit vector from the point to the sphere's centre
    T distance;              ///< d, to the centre; scene units
    T radius;                ///< r; scene units
    T gap2;                  ///< d² − r²; scene units squared, > 0
    T sin_max;               ///< sin θ_max = r/d
    T inverse_one_plus_cos;  ///< 1/(1 + cos θ_max), in [½, 1]
    T inverse_distance;      ///< 1/d

    /// 1 − cos θ_max = sin²θ_max/(1 + cos θ_max).
    MIS_INLINE T one_minus_cos() const { return sin_max * (sin_max * inverse_one_plus_cos); }
    /// Steradians.
    MIS_INLINE T solid_angle() const { return T(two_pi<T>) * one_minus_cos(); }
};

/// The cap of a sphere of radius `radius` whose centre is at `to_center` from the point.
/// gap2: d² − r², from double where the point is near the sphere. Precondition: gap2 > 0.
/// Accuracy: solid angle within 1e-6 in float for θ_max from 1e-20 rad to 89.9° (cap_test.cpp).
/// Source: Shirley, Wang and Zimmerman 1996, "Monte Carlo Techniques for Direct Lighting
/// Calculations"; docs/theory.md, eq. 3.
template <class T>
MIS_INLINE Cap<T> cap_towards(const Vec3<T>& to_center, const T& radius, const T& gap2)
{
    using std::sqrt;
    const T d = length(to_center);
    const T inverse_d = number<T>(1) / d;
    const T cos_max = sqrt(gap2) * inverse_d;
    return {to_center * inverse_d,
            d,
            radius,
            gap2,
            radius * inverse_d,
            number<T>(1) / (number<T>(1) + cos_max),
            inverse_d};
}

/// The same from the sphere and the point themselves, in one number type.
template <class T>
MIS_INLINE Cap<T> cap_of_sphere(const Vec3<T>& center, const T& radius, const Vec3<T>& x)
{
    const Vec3<T> to_center = center - x;
    const T d = length(to_center);
    return cap_towards(to_center, radius, (d - radius) * (d + radius));
}

}  // namespace mis
