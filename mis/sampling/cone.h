#pragma once

#include "mis/math/cap.h"
#include "mis/math/turn.h"
#include "mis/sampling/horizon.h"

#include <limits>

namespace mis {

/// A direction drawn in a cap. The offset from the axis is kept beside the rounded direction: a
/// float direction rounds at some 2e-8 rad, which is more than a small cap is wide.
template <class T> struct CapDraw {
    Vec3<T> wi;          ///< unit direction
    Vec3<T> offset;      ///< wi − axis, with full relative precision
    T distance;          ///< along wi to the near side of the sphere; scene units
    T inverse_pdf_sin2;  ///< 1/(pdf · sin²θ_max), sr: finite where 1/pdf would underflow
    /// n·wi as it was drawn, which wi, once rounded, no longer knows near the horizon; 0 or less
    /// where the draw is not above it, or there is none. Of a technique that knows n.
    T cos_theta;
};

/// The point (in polar coordinates about the axis) of the cap at which sin²θ = w · sin²θ_max, at
/// the azimuth of a point of the circle. one_minus_cos: of θ.
template <class T>
MIS_INLINE CapDraw<T> cap_draw_at(const Cap<T>& cap, const T& w, const T& one_minus_cos,
                                  const OnCircle<T>& azimuth)
{
    using std::sqrt;
    const T sin_theta = cap.sin_max * sqrt(w);
    const Frame<T> frame = frame_around(cap.axis);
    const Vec3<T> offset = frame.x * (sin_theta * azimuth.cos) +
                           frame.y * (sin_theta * azimuth.sin) - cap.axis * one_minus_cos;
    const T half_chord = cap.radius * sqrt(max_of(number<T>(1) - w, number<T>(0)));
    const T along = cap.distance * (number<T>(1) - one_minus_cos);
    return {cap.axis + offset, offset, cap.gap2 / (along + half_chord), number<T>(0), number<T>(0)};
}

/// A direction uniform in solid angle over the cap. u: two uniform numbers in [0, 1).
/// Source: Shirley, Wang and Zimmerman 1996; in 1 − cos θ, so that nothing cancels
/// (docs/theory.md, eq. 5).
template <class T> MIS_INLINE CapDraw<T> sample_cone(const Cap<T>& cap, const Vec2<T>& u)
{
    const T one_minus_cos = u.x * cap.one_minus_cos();  // uniform when the direction is
    const T w = u.x * cap.inverse_one_plus_cos * (number<T>(2) - one_minus_cos);
    CapDraw<T> draw = cap_draw_at(cap, w, one_minus_cos, on_circle(u.y));
    draw.inverse_pdf_sin2 = T(two_pi<T>) * cap.inverse_one_plus_cos;
    return draw;
}

/// The same over a surface of the unit normal n: with the cosine, and with a direction that is
/// above the horizon where the draw is. Of a cap that is all above it, every draw is.
template <class T>
MIS_INLINE CapDraw<T> sample_cone_over(const Cap<T>& cap, const Vec3<T>& n, const Vec2<T>& u)
{
    CapDraw<T> draw = sample_cone(cap, u);
    const T cos_beta = dot(n, cap.axis), cos_theta = cos_beta + dot(n, draw.offset);
    const T least = select(cos_beta >= cap.sin_max, number<T>(least_cosine), cos_theta);
    draw.cos_theta = max_of(least, cos_theta);
    draw.wi = kept_above(draw.wi, n, draw.cos_theta);
    return draw;
}

/// Density of sample_cone, per steradian; infinite for caps below 1e-19 rad in float.
template <class T> MIS_INLINE T cone_pdf(const Cap<T>& cap)
{
    const T least(std::numeric_limits<Scalar<T>>::denorm_min());
    return number<T>(1) / max_of(cap.solid_angle(), least);
}

}  // namespace mis
