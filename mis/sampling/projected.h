#pragma once

#include "mis/math/irradiance.h"
#include "mis/sampling/cone.h"
#include "mis/sampling/horizon.h"

#include <array>
#include <cstddef>
#include <limits>

namespace mis {

namespace detail {

/// A point of a cap above the horizon, relative to the cap's axis.
template <class T> struct ProjectedPoint {
    /// wi − axis over sin θ_max: along the surface towards the light, across, and along n.
    Vec3<T> offset;
    T depth;      ///< (cos α − cos θ_max)/sin²θ_max, α the angle between wi and axis
    T cos_theta;  ///< of wi to n
};

/// cos β/sin θ_max, at most 1e15 either way: beyond, it is as good as infinite, and has a square.
template <class T> MIS_INLINE T height_over_sin(const TiltedCap<T>& cap)
{
    const T most = number<T>(1e15);
    return max_of(min_of(T(cap.cos_beta / max_of(cap.sin_max, number<T>(1e-37))), most), T(-most));
}

/// Uniform in the ellipse under the disc that the cap's rim bounds: the projection of the cap where
/// all of it is above the horizon. docs/theory.md, eq. 57.
template <class T>
MIS_INLINE ProjectedPoint<T> point_over_ellipse(const TiltedCap<T>& cap, const Vec2<T>& u)
{
    using std::sqrt;
    const T zero = number<T>(0), one = number<T>(1), gamma = height_over_sin(cap);
    const T rho = sqrt(u.x), rest = one - u.x;
    const OnCircle<T> azimuth = on_circle(u.y);
    const T p = rho * azimuth.cos, q = rho * azimuth.sin;
    const T height = cap.cos_max * gamma + p * cap.sin_beta, z = sqrt(height * height + rest);
    const T lift =
        select(height > zero, rest / max_of(T(z + height), number<T>(1e-37)), z - height);
    const T sag = cap.sin_max / (one + cap.cos_max);
    const T rise = p * cap.sin_beta + lift - sag * cap.cos_beta;
    // Near the horizon without a difference; far above it nothing cancels, but γ² overflows.
    const T cos_theta =
        select(gamma > number<T>(2), cap.cos_beta + cap.sin_max * rise, cap.sin_max * z);
    return {
        {-sag * cap.sin_beta - p * cap.cos_beta, q, rise}, lift * max_of(gamma, zero), cos_theta};
}

/// What lies between that ellipse and the horizon where the horizon cuts the cap: a lune. Slices
/// across it, each a chord from the ellipse's edge to the unit circle, go by T = tan ψ/2, ψ the
/// ellipse's parameter; T_t is where both edges meet. docs/theory.md, eqs. 58 to 60.
template <class T> struct Lune {
    T s, cos_max, sin_beta;
    T mu;       ///< |cos β|/sin θ_max, at most 1
    T end;      ///< T_t, in [0, 1]
    T end_gap;  ///< 1 − T_t²

    /// Of a cap that the horizon does not cut, where z2 ≤ 0, one of no use but finite.
    MIS_INLINE Lune(const TiltedCap<T>& cap, const T& z2)
        : s(cap.sin_max), cos_max(cap.cos_max), sin_beta(cap.sin_beta)
    {
        using std::abs, std::sqrt;
        mu = min_of(T(abs(height_over_sin(cap))), number<T>(1));
        const T rise = mu * cos_max, both = max_of(T(sin_beta + rise), number<T>(1e-30));
        end = min_of(T(sqrt(max_of(z2, number<T>(0))) / both), number<T>(1));
        end_gap = min_of(T(number<T>(2) * rise / both), number<T>(1));
    }

    /// 1 − T² at T = T_t (1 − p).
    MIS_INLINE T gap(const T& p) const { return end_gap + end * end * (p * (number<T>(2) - p)); }
    /// (1 + T²) times the abscissa of the unit circle there, from 1 − T².
    MIS_INLINE T circle(const T& gap_here) const
    {
        using std::sqrt;
        const T t2 = number<T>(1) - gap_here;
        return sqrt(gap_here * gap_here + number<T>(4) * cos_max * cos_max * t2);
    }
    /// (1 + T²) times that of the ellipse's edge.
    MIS_INLINE T ellipse(const T& gap_here) const
    {
        return cos_max * sin_beta * (number<T>(2) - gap_here) + s * s * mu * gap_here;
    }

    /// The area between p and the end, over p³ and a constant: eq. 59.
    MIS_INLINE T area_over_p3(const T& p) const
    {
        struct Node {
            double x, weight;
        };
        // Gauss's for the weight x² on [0, 1] (Jacobi polynomials, α = 0, β = 2).
        constexpr std::array<Node, 6> nodes{{{0.113194383822438134, 0.00183107580686929773},
                                             {0.284318872688286081, 0.0157202971849450513},
                                             {0.490963586835247916, 0.0512895711296162102},
                                             {0.697563081977108767, 0.0945771867485412036},
                                             {0.868436058342014866, 0.107376499736780633},
                                             {0.974095444906332807, 0.0625387027265809379}}};
        T sum = number<T>(0);
        for (const Node& node : nodes)
            sum += number<T>(node.weight) * slice(T(p * number<T>(node.x)));
        return sum;
    }
    /// d area/dp, over p² and the same constant.
    MIS_INLINE T slice(const T& p) const
    {
        const T here = gap(p), one_plus_t2 = number<T>(2) - here;
        const T edges = max_of(T(circle(here) + ellipse(here)), number<T>(1e-30));
        return square(number<T>(2) - p) * here / (one_plus_t2 * one_plus_t2 * one_plus_t2 * edges);
    }

    /// p at which this share of the area of a half, in (0, 1], lies between p and the end: Newton's
    /// steps in the logarithms, in which area over p is nearly a straight line. Two of them, and
    /// the nodes, leave an error of 3e-6 of the area.
    MIS_INLINE T position_of(const T& share) const
    {
        using std::exp, std::log;
        const T one = number<T>(1), wanted = share * area_over_p3(one);
        T p = exp(log(share) * number<T>(1.0 / 3));
        for (int step = 0; step < 2; ++step) {
            const T over_p3 = area_over_p3(p);
            const T slope = slice(p) / over_p3;  // d log area/d log p
            p = min_of(T(p * exp(log(wanted / (p * p * p * over_p3)) / slope)), one);
        }
        return p;
    }

    /// The point on the slice at p, on the side of the sign of `side`, at this share of the chord
    /// from the horizon inwards. gamma: cos β/sin θ_max.
    MIS_INLINE ProjectedPoint<T> point(const T& p, const T& side, const T& share,
                                       const T& gamma) const
    {
        using std::sqrt;
        const T one = number<T>(1), two = number<T>(2), zero = number<T>(0),
                least = number<T>(1e-30);
        const T here = gap(p), over = one / (two - here);
        const T r = circle(here) * over, edge = ellipse(here) * over;
        const T across = side * two * end * (one - p) * over;  // sin ψ
        // How high the cap's rim is over the edge, in units of sin θ_max; the chord, of sin²θ_max.
        const T rim = two * sin_beta * end * end * (p * (two - p)) * over / (two - end_gap);
        const T chord = rim * rim / max_of(T(r + edge), least);
        const T outer = share * chord, inner = chord - outer, x = r - s * s * outer;
        // √(outer (r + x)), of which neither factor need have a square that is a normal number.
        const T z = rim * sqrt(share * (r + x) / max_of(T(r + edge), least));
        const T sum = max_of(T(z + rim), least);
        const T sunken = inner * (sin_beta + mu * (x + edge) / sum);
        const T raised = inner * sin_beta + mu * (z + rim);
        const T along = gamma * gamma / (one + sin_beta) - across * across / (one + r) - outer;
        return {{s * along, across, z - gamma}, select(gamma > zero, raised, sunken), s * z};
    }
};

/// What a number u = 0 stands for, of a chord that begins on the horizon: the middle of the 2⁻³²
/// below the next random number.
inline constexpr double least_share = 0x1p-33;

/// Two uniform numbers → a point whose projection onto the surface is uniform. z2: chord2(cap);
/// irradiance: of the cap, over sin²θ_max.
template <class T>
MIS_INLINE ProjectedPoint<T> projected_point(const TiltedCap<T>& cap, const T& z2,
                                             const T& irradiance, const Vec2<T>& u)
{
    const T zero = number<T>(0), one = number<T>(1), least = number<T>(1e-30);
    const T above = T(pi<T>) * max_of(cap.cos_beta, zero);
    const T ellipse = above / max_of(irradiance, number<T>(1e-37));   // its share of the area
    const T last(1 - std::numeric_limits<Scalar<T>>::epsilon() / 2);  // below 1
    ProjectedPoint<T> point =
        point_over_ellipse(cap, Vec2<T>(min_of(last, T(u.x / max_of(ellipse, least))), u.y));
    const auto is_beside = (u.x >= ellipse) & (z2 > zero);
    if (!any_lane(is_beside)) return point;
    const T rest = max_of(T(one - ellipse), least);
    const T from_left = max_of(T(u.x - ellipse), zero), from_right = one - u.x;
    const T share = number<T>(2) * min_of(from_left, from_right) / rest;
    const Lune<T> lune(cap, z2);
    const T p = lune.position_of(min_of(max_of(share, number<T>(1e-24)), one));
    const T gamma = max_of(min_of(height_over_sin(cap), one), T(-one));
    const ProjectedPoint<T> beside = lune.point(p, select(from_left < from_right, T(-one), one),
                                                max_of(number<T>(least_share), u.y), gamma);
    point.offset.x = select(is_beside, beside.offset.x, point.offset.x);
    point.offset.y = select(is_beside, beside.offset.y, point.offset.y);
    point.offset.z = select(is_beside, beside.offset.z, point.offset.z);
    point.depth = select(is_beside, beside.depth, point.depth);
    point.cos_theta = select(is_beside, beside.cos_theta, point.cos_theta);
    return point;
}

}  // namespace detail

/// A direction in proportion to the cosine to n over the part of the cap that is above the horizon:
/// its projection onto the tangent plane is uniform. u: two uniform numbers in [0, 1), of which
/// none is lost: n·wi and cos_theta are positive. Where no part is above, both cos_theta and
/// inverse_pdf_sin2 are 0. Accuracy: areas to 1e-5 in float and 3e-6 in double of
/// what `tilted` says, exact to rounding where the horizon cuts nothing (projected_test.cpp). Caps
/// of 1e-20 rad keep their digits. Source: Ureña and Georgiev 2018, "Stratified Sampling of
/// Projected Spherical Caps", whose ellipse and parallel map these are, in forms that do not
/// cancel: docs/theory.md, eqs. 56 to 61.
template <class T>
MIS_INLINE CapDraw<T> sample_projected(const Cap<T>& cap, const Vec3<T>& n, const Vec2<T>& u)
{
    using std::sqrt;
    const T zero = number<T>(0), one = number<T>(1), two = number<T>(2);
    const TiltedCap<T> seen = tilted(cap, n);
    const T irradiance = irradiance_over_sin2(seen);
    const detail::ProjectedPoint<T> point =
        detail::projected_point(seen, detail::chord2(seen), irradiance, u);

    const Frame<T> frame = frame_around(n);
    const Vec3<T> axis = frame.to_local(cap.axis);
    const T flat = sqrt(axis.x * axis.x + axis.y * axis.y);
    const auto is_tilted = flat > number<T>(1e-18);
    const T over_flat = one / select(is_tilted, flat, one);
    const T cos_phi = select(is_tilted, axis.x * over_flat, one);
    const T sin_phi = select(is_tilted, axis.y * over_flat, zero);
    const T x = point.offset.x, y = point.offset.y;
    const Vec3<T> offset =
        frame.to_world({x * cos_phi - y * sin_phi, x * sin_phi + y * cos_phi, point.offset.z}) *
        cap.sin_max;

    const T s2_depth = cap.sin_max * (cap.sin_max * point.depth);
    const T half_chord = cap.radius * sqrt(point.depth * (two * seen.cos_max + s2_depth));
    const T along = cap.distance * (seen.cos_max + s2_depth);
    const T cos_theta = max_of(number<T>(least_cosine), point.cos_theta);
    // Of a cap below the horizon 0, or what numbers that are none make of it.
    const T cosine = select(irradiance > zero, cos_theta, cos_theta * zero);
    return {kept_above(Vec3<T>(cap.axis + offset), n, cosine), offset,
            cap.gap2 / (along + half_chord), irradiance / cos_theta, cosine};
}

/// Density of sample_projected, per steradian, at an angle of this cosine to n; 0 below the
/// horizon, infinite for caps below 1e-19 rad in float.
template <class T>
MIS_INLINE T projected_pdf(const Cap<T>& cap, const Vec3<T>& n, const T& cos_theta)
{
    const T zero = number<T>(0), one = number<T>(1);
    const T irradiance = irradiance_over_sin2(tilted(cap, n));
    const auto is_seen = (irradiance > zero) & (cos_theta > zero);
    const T pdf = cos_theta / select(is_seen, irradiance, one) / cap.sin_max / cap.sin_max;
    return select(is_seen, pdf, zero);
}

}  // namespace mis
