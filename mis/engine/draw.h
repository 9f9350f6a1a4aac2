#pragma once

#include "mis/math/cap.h"
#include "mis/math/sphere.h"
#include "mis/sampling/cone.h"
#include "mis/trace/lights.h"

#include <array>
#include <cstddef>
#include <limits>

namespace mis {

// What one draw is worth: the arithmetic of the pipeline's stages, where V is the lanes' type, and
// of a host's own loop (direct.h), where it is a number.

/// How many draws of each technique a sample has, or, in the one-sample model, their
/// probabilities.
template <class T> struct DirectCounts {
    T light = 1;  ///< draws towards lights
    T bsdf = 1;   ///< draws of the BSDF
};

/// d² − r² of a light whose centre is at `to_center`, in double, as cap_of_light() takes it.
MIS_INLINE double gap2_of(const Vec3<double>& to_center, double radius)
{
    return length2(to_center) - radius * radius;
}

/// The cap of a light whose centre is at `to_center`. A point that rounding puts onto the light
/// sees a hemisphere of it, never the root of a negative number.
template <class V>
MIS_INLINE Cap<V> cap_of_light(const Vec3<V>& to_center, const V& radius, const V& gap2)
{
    return cap_towards(to_center, radius, max_of(gap2, number<V>(1e-37)));
}

/// Density of a draw towards lights, per steradian, the light's probability in it. Draws of either
/// technique are priced by it, to the last bit: or both halves of `maximum` could think the other's
/// density the larger.
template <class Technique, class V>
MIS_INLINE V light_density(const V& probability, const Cap<V>& cap, const Vec3<V>& n,
                           const V& cos_theta)
{
    return probability * Technique::pdf(cap, n, cos_theta);
}

/// The light's radiance over the density of the draw within its cap, which may be too large for a
/// number. 1/pdf = sin² · inverse_pdf_sin2 is taken one sine at a time: the square of a tiny radius
/// is no normal number.
template <class V>
MIS_INLINE Vec3<V> radiance_over_pdf(const Vec3<V>& radiance_radius, const Cap<V>& cap,
                                     const CapDraw<V>& draw)
{
    const V inverse_pdf_sin = cap.sin_max * draw.inverse_pdf_sin2;
    return radiance_radius * cap.inverse_distance * inverse_pdf_sin;
}

/// What a heuristic gives technique i (0: light, 1: BSDF) of a direction of these densities.
template <class Heuristic, class V>
MIS_INLINE V weight_of(std::size_t i, const DirectCounts<V>& counts, const V& light_pdf,
                       const V& bsdf_pdf)
{
    return Heuristic::weight(std::array<V, 2>{counts.light * light_pdf, counts.bsdf * bsdf_pdf}, i);
}

/// What a light draw adds to the estimate; f_cos: f · cos θ.
template <class V>
MIS_INLINE Vec3<V> light_draw_share(const Vec3<V>& f_cos, const Vec3<V>& radiance_over_pdf,
                                    const V& weight, const DirectCounts<V>& counts,
                                    const V& probability)
{
    return f_cos * radiance_over_pdf * (weight / (counts.light * probability));
}

/// What a BSDF draw adds to the estimate.
template <class V>
MIS_INLINE Vec3<V> bsdf_draw_share(const Vec3<V>& f_cos, const Vec3<V>& radiance, const V& weight,
                                   const DirectCounts<V>& counts, const V& bsdf_pdf)
{
    return f_cos * radiance * (weight / (counts.bsdf * bsdf_pdf));
}

/// The direction of a light draw without the rounding to T: axis in double, plus the offset.
MIS_INLINE Vec3<double> exact_direction(const Vec3<double>& to_center, const Vec3<double>& offset)
{
    return normalized(normalized(to_center) + offset);
}

/// Where a light draw meets its own light; at the rim, where rounding may miss it, the nearest
/// point of the ray.
MIS_INLINE LightHit own_hit(LightIndex light, const Vec3<double>& to_center, double radius,
                            const Vec3<double>& wi)
{
    const double distance = hit_distance(to_center, radius, wi);
    return {light,
            distance < std::numeric_limits<double>::infinity() ? distance : dot(to_center, wi)};
}

}  // namespace mis
