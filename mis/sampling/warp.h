#pragma once

#include "mis/math/turn.h"

namespace mis {

// Directions about the z axis, each beside its density per steradian. u: two uniform numbers in [0,
// 1). Equation numbers "GI" are of Dutré, Global Illumination Compendium (2003).

/// The direction whose 1 − cos θ is given, at the azimuth of a point of the circle.
template <class T>
MIS_INLINE Vec3<T> direction_at(const T& one_minus_cos, const OnCircle<T>& azimuth)
{
    using std::sqrt;
    const T sin_theta = sqrt(one_minus_cos * (number<T>(2) - one_minus_cos));
    return {sin_theta * azimuth.cos, sin_theta * azimuth.sin, number<T>(1) - one_minus_cos};
}

/// Uniform over the hemisphere z > 0 (GI 34).
template <class T> MIS_INLINE Vec3<T> sample_hemisphere(const Vec2<T>& u)
{
    return direction_at(u.x, on_circle(u.y));
}
template <class T> MIS_INLINE T hemisphere_pdf() { return number<T>(0.15915494309189533577); }

/// In proportion to cos θ (GI 35): sin²θ is uniform.
template <class T> MIS_INLINE Vec3<T> sample_cosine(const Vec2<T>& u)
{
    using std::sqrt;
    const T sin_theta = sqrt(u.x);
    const OnCircle<T> azimuth = on_circle(u.y);
    return {sin_theta * azimuth.cos, sin_theta * azimuth.sin, sqrt(number<T>(1) - u.x)};
}
template <class T> MIS_INLINE T cosine_pdf(const T& cos_theta)
{
    return cos_theta * number<T>(0.31830988618379067154);
}

/// In proportion to cos^m θ (GI 36).
template <class T> MIS_INLINE Vec3<T> sample_lobe(const Vec2<T>& u, double m)
{
    return direction_at(one_minus_cos_of_lobe(u.x, m), on_circle(u.y));
}
template <class T> MIS_INLINE T lobe_pdf(const T& sin2, const T& cos2, double m)
{
    return number<T>((m + 1) / 6.28318530717958647692) * pow_cos(sin2, cos2, m);
}

}  // namespace mis
