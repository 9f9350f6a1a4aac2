#pragma once

#include "mis/math/stable.h"

namespace mis {

// Directions about the z axis, each beside its density per steradian. u: two uniform numbers in [0,
// 1). Equation numbers "GI" are of Dutré, Global Illumination Compendium (2003).

/// The direction at azimuth φ whose 1 − cos θ is given.
template <class T> MIS_INLINE Vec3<T> direction_at(const T& one_minus_cos, const T& phi)
{
    using std::sqrt, std::cos, std::sin;
    const T sin_theta = sqrt(one_minus_cos * (number<T>(2) - one_minus_cos));
    return {sin_theta * cos(phi), sin_theta * sin(phi), number<T>(1) - one_minus_cos};
}

/// Uniform over the hemisphere z > 0 (GI 34).
template <class T> MIS_INLINE Vec3<T> sample_hemisphere(const Vec2<T>& u)
{
    return direction_at(u.x, T(two_pi<T>) * u.y);
}
template <class T> MIS_INLINE T hemisphere_pdf() { return number<T>(0.15915494309189533577); }

/// In proportion to cos θ (GI 35): sin²θ is uniform.
template <class T> MIS_INLINE Vec3<T> sample_cosine(const Vec2<T>& u)
{
    using std::sqrt, std::cos, std::sin;
    const T sin_theta = sqrt(u.x), phi = T(two_pi<T>) * u.y;
    return {sin_theta * cos(phi), sin_theta * sin(phi), sqrt(number<T>(1) - u.x)};
}
template <class T> MIS_INLINE T cosine_pdf(const T& cos_theta)
{
    return cos_theta * number<T>(0.31830988618379067154);
}

/// In proportion to cos^m θ (GI 36).
template <class T> MIS_INLINE Vec3<T> sample_lobe(const Vec2<T>& u, double m)
{
    return direction_at(one_minus_cos_of_lobe(u.x, m), T(two_pi<T>) * u.y);
}
template <class T> MIS_INLINE T lobe_pdf(const T& sin2, const T& cos2, double m)
{
    return number<T>((m + 1) / 6.28318530717958647692) * pow_cos(sin2, cos2, m);
}

}  // namespace mis
