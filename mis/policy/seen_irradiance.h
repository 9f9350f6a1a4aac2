#pragma once

#include "mis/policy/seen_light.h"

namespace mis {

namespace detail {

/// By how much a sine is uncertain. coordinates: the largest over the distance.
template <class T> MIS_INLINE T blur_of(const T& coordinates)
{
    return number<T>(8) * T(std::numeric_limits<Scalar<T>>::epsilon()) * coordinates;
}

/// Of a light that rounding may have put below the horizon: E/sin²θ_max of one that is as far
/// above tangency as angles are uncertain, for it may be visible. coordinates: the largest over
/// the distance. docs/theory.md, eq. 52.
template <class T> MIS_INLINE T least_over_sin2(const TiltedCap<T>& cap, const T& coordinates)
{
    using std::sqrt;
    const T blur = blur_of(coordinates);
    const T share = blur / max_of(cap.sin_max, blur);
    const T least = blur * share * sqrt(share);
    return select(cap.sin_max + cap.cos_beta > -blur, least, number<T>(0));
}

}  // namespace detail

/// E/sin²θ_max of a light as a policy weighs it: positive for all that may be above the horizon.
/// from_origin: of the point, from the origin of the lights' columns.
template <class T>
MIS_INLINE T seen_irradiance_over_sin2(const SeenLight<T>& light, const TiltedCap<T>& cap,
                                       const T& from_origin)
{
    using std::abs;
    const T coordinates = number<T>(1) + from_origin * light.inverse_distance();
    // Well above the horizon or below, as most lights are: nothing else to look at.
    const T near_horizon = number<T>(1.01) * (cap.sin_max + detail::blur_of<T>(coordinates));
    if (!any_lane(abs(cap.cos_beta) <= near_horizon))
        return T(pi<T>) * max_of(cap.cos_beta, number<T>(0));
    return max_of(irradiance_over_sin2(cap), detail::least_over_sin2<T>(cap, coordinates));
}

/// Y(L)·E of a light, but for a common factor: (Y(L)·r/d) · sin θ_max · E/sin²θ_max.
template <class T>
MIS_INLINE T radiant_irradiance(const SeenLight<T>& light, const TiltedCap<T>& cap,
                                const T& irradiance)
{
    return light.luminance_radius * light.inverse_distance() * (cap.sin_max * irradiance);
}

}  // namespace mis
