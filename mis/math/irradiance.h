#pragma once

#include "mis/math/cap.h"

#include <array>

namespace mis {

/// A cap over a surface: what its irradiance depends on. Of each angle both sine and cosine, as the
/// one that is small carries the digits (docs/theory.md §2).
template <class T> struct TiltedCap {
    T sin_max, cos_max;    ///< of the half-angle: r/d, √(d² − r²)/d
    T cos_beta, sin_beta;  ///< of the angle between axis and normal, in [0, π]
};

/// The cap as the unit normal n sees it.
template <class T> MIS_INLINE TiltedCap<T> tilted(const Cap<T>& cap, const Vec3<T>& n)
{
    using std::sqrt;
    return {cap.sin_max, sqrt(cap.gap2) / cap.distance, dot(n, cap.axis),
            length(cross(n, cap.axis))};
}

namespace detail {

/// ∫₀¹ u²(1 − u²)/((1 + a u²)(1 + b u²)) du for a in [0, 9/4], b in [0, 1], to 2e-12: twelve Gauss
/// nodes in u² for the weight u²(1 − u²) du (Jacobi polynomials, α = 1, β = ½; Golub and Welsch
/// 1969).
template <class T> MIS_INLINE T chord_integral(const T& a, const T& b)
{
    struct Node {
        double u2, weight;
    };
    constexpr std::array<Node, 12> nodes{{{0.0140034879205422618, 0.00162625425874764282},
                                          {0.0552303971902331753, 0.006016119251301659},
                                          {0.121373907284162174, 0.0118576689275836054},
                                          {0.208733007221071058, 0.017429005957075855},
                                          {0.312419581152083432, 0.0211331618449005257},
                                          {0.426631915914130636, 0.0219791825785470523},
                                          {0.544979324770427575, 0.0198536032340402401},
                                          {0.660839718014924518, 0.0154984825630507305},
                                          {0.767730095886681483, 0.010211630501702459},
                                          {0.859669166133468475, 0.00537776355130242251},
                                          {0.931511438753367923, 0.00199450998775644425},
                                          {0.979230900935377878, 0.000355950677324696743}}};
    const T one = number<T>(1);
    const auto divisor = [&](const Node& node) {
        return (one + a * number<T>(node.u2)) * (one + b * number<T>(node.u2));
    };
    T sum = number<T>(0);
    for (std::size_t k = 0; k < nodes.size(); k += 2) {  // two terms to a division
        const T first = divisor(nodes[k]), second = divisor(nodes[k + 1]);
        sum += (number<T>(nodes[k].weight) * second + number<T>(nodes[k + 1].weight) * first) /
               (first * second);
    }
    return sum;
}

/// z² = 1 − cos²β/sin²θ_max, the square of the chord that the horizon cuts out of the disc, as a
/// share of its diameter; 0 where it cuts none. From the sines where they are small, from the
/// cosines where those are.
template <class T> MIS_INLINE T chord2(const TiltedCap<T>& cap)
{
    using std::abs;
    const T zero = number<T>(0), least = number<T>(1e-37);
    const T s = max_of(cap.sin_max, least), m = min_of(T(abs(cap.cos_beta)), s);
    const T inverse = number<T>(1) / s;
    const T by_sines = (s - m) * inverse * ((s + m) * inverse);
    const T by_cosines =
        (cap.sin_beta - cap.cos_max) * inverse * ((cap.sin_beta + cap.cos_max) * inverse);
    return max_of(select(s < number<T>(0.7), by_sines, by_cosines), zero);
}

/// What is left above the horizon of a cap whose centre is below it: E/sin²θ_max where cos β = −m ≤
/// 0. K of docs/theory.md, eq. 49, in the three forms of eq. 51, of which one is always stable.
template <class T> MIS_INLINE T sunken_irradiance_over_sin2(const TiltedCap<T>& cap, const T& z2)
{
    using std::abs, std::atan, std::sqrt;
    const T zero = number<T>(0), one = number<T>(1), least = number<T>(1e-37);
    const T s = cap.sin_max, m = min_of(T(abs(cap.cos_beta)), one);
    const T sin2_beta = cap.sin_beta * cap.sin_beta, one_minus_m = sin2_beta / (one + m);
    const T sz = s * sqrt(z2), t = sz / max_of(cap.cos_max, number<T>(1e-15)), t2 = t * t;
    const T atan_t = atan(t), w = atan(t * one_minus_m / max_of(T(m + t2), least));

    const T widest = number<T>(1.5) * m;
    const auto is_narrow = t <= widest;
    const T q = min_of(t, widest) / max_of(m, least), q2 = q * q;
    const T integral = chord_integral<T>(select(is_narrow, q2, zero), min_of(t2, one));
    const T narrow = q2 * integral;

    const T p = min_of(m, t) / max_of(t, least), p2 = p * p;  // 1/q
    const T bow = number<T>(2.0 / 3) + p2 - p * (one + p2) * (atan_t + w);
    const T wide = (bow - t2 * integral) / max_of(sin2_beta, least);

    const T high =
        (one_minus_m * atan_t - m * w - cap.cos_max * (sz - cap.cos_max * m * (atan_t + w))) /
        max_of(T(s * s), least);
    return select(t > one, high, z2 * t * select(is_narrow, narrow, wide));
}

}  // namespace detail

/// E/sin²θ_max: the cosine-weighted solid angle of the part of a cap that is above the horizon,
/// over the square of its sine. π cos β where all of it is above, 0 where none is. E itself is this
/// times sin θ_max, twice: a tiny radius has a square that is no normal number.
/// Accuracy: 1e-5 in float and 1e-11 in double of what the four numbers say, for s from 1e-20 to 1
/// and up to tangency; positive while sin θ_max > −cos β there (irradiance_test.cpp). Of an angle
/// that is itself rounded by ε, 5/2 ε/(θ_max + π/2 − β) is lost towards tangency.
/// Source: Snyder 1996, "Area Light Sources for Real-Time Graphics"; docs/theory.md, eqs. 48 to 51.
template <class T> MIS_INLINE T irradiance_over_sin2(const TiltedCap<T>& cap)
{
    const T above = T(pi<T>) * max_of(cap.cos_beta, number<T>(0));
    const T z2 = detail::chord2(cap);
    if (!any_lane(z2 > number<T>(0))) return above;
    return above + detail::sunken_irradiance_over_sin2(cap, z2);
}

}  // namespace mis
