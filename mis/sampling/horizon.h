#pragma once

#include "mis/math/stable.h"

#include <limits>

namespace mis {

/// No draw above the horizon has a smaller cosine: times a BSDF it is a normal float.
inline constexpr double least_cosine = 1e-30;

/// A unit direction that was drawn at the cosine cos_theta to the unit normal n, so rounded that it
/// is above the horizon if the draw was: n·wi > 0 however its three products are added up. What
/// rounding left less than four ulp above the horizon, or below it, is raised to there; all else
/// stays as it is to the last bit. n may be off a unit vector by a float's rounding in any number
/// type, as points keep it in float. docs/theory.md §2, "Draws at the horizon".
template <class T>
MIS_INLINE Vec3<T> kept_above(const Vec3<T>& wi, const Vec3<T>& n, const T& cos_theta)
{
    const T zero = number<T>(0), high = number<T>(8 * 0x1p-23);  // too high to be rounded away
    if (!any_lane(cos_theta < high)) return wi;
    const T lowest(4 * std::numeric_limits<Scalar<T>>::epsilon());
    const T lift = max_of(T(lowest - dot(n, wi)), zero) * number<T>(1 + 0x1p-20);  // n·n < 1
    return wi + n * select(cos_theta > zero, lift, zero);
}

}  // namespace mis
