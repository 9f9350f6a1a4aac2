#pragma once

#include "mis/policy/light_tree.h"
#include "mis/policy/seen_product.h"

#include <cstring>

namespace mis {

using LightRow = LightTree::Row<double>;

/// A point as the tree's groups see it.
template <class S> struct TreePoint {
    ChoicePoint<S> point;  ///< its x in units
    Vec3<double> x;        ///< in scene axes and lengths
    double inverse_unit;   ///< of the lengths that are formed here: as far as the farthest light
};

namespace detail {

/// Places of a row, or lengths, times a factor, in another number type. (Doubles go without the
/// array: GCC 12 makes wrong code of it for eight of them at -O3, as its SLP vectoriser is on.)
template <class T>
MIS_INLINE T lanes_of_row(const LightRow& row, std::size_t first, double from, double factor)
{
    if constexpr (std::is_same_v<Scalar<T>, double>) {
        return T((load_lanes<T>(&row[first]) - T(from)) * T(factor));
    } else {
        alignas(64) std::array<Scalar<T>, lane_count<T>> some;  // NOLINT: filled at once
        for (std::size_t k = 0; k < lane_count<T>; ++k)
            some[k] = static_cast<Scalar<T>>((row[first + k] - from) * factor);
        return load_lanes<T>(some.data());
    }
}

/// Floats of a row in another number type.
template <class T> MIS_INLINE T lanes_of_row(const LightTree::Row<float>& row, std::size_t first)
{
    constexpr std::size_t count = lane_count<T>;
    if constexpr (std::is_same_v<Scalar<T>, float>) {
        return load_lanes<T>(&row[first]);
    } else if constexpr (count == 1) {
        return static_cast<T>(row[first]);
    } else {
        using Doubles = typename CompilerLanes<double, count>::Type;
        typename CompilerLanes<float, count>::Type some;  // NOLINT: filled at once
        std::memcpy(&some, &row[first], sizeof some);
        const Doubles wide = __builtin_convertvector(some, Doubles);
        alignas(64) std::array<double, count> numbers;  // NOLINT: filled at once
        std::memcpy(numbers.data(), &wide, sizeof wide);
        return load_lanes<T>(numbers.data());
    }
}

}  // namespace detail

/// What `product` says of the lights of a group.
template <class T, class Reflection>
MIS_OWN_COPY void weigh_lights(const Reflection& reflection, const TreePoint<Scalar<T>>& at,
                               const LightTree::LightGroup& group, LightRow& weights)
{
    const Vec3<T> n{T(at.point.n.x), T(at.point.n.y), T(at.point.n.z)};
    const T from_origin(length(at.point.x));
    alignas(64) LightTree::Row<Scalar<T>> found;  // NOLINT: filled at once
    for (std::size_t k = 0; k < LightTree::width; k += lane_count<T>) {
        const Vec3<T> to_center{detail::lanes_of_row<T>(group.x, k, at.x.x, at.inverse_unit),
                                detail::lanes_of_row<T>(group.y, k, at.x.y, at.inverse_unit),
                                detail::lanes_of_row<T>(group.z, k, at.x.z, at.inverse_unit)};
        const SeenLight<T> light{
            to_center, dot(to_center, to_center),
            detail::lanes_of_row<T>(group.radius, k, 0, at.inverse_unit),
            detail::lanes_of_row<T>(group.luminance_radius, k, 0, 1 / at.inverse_unit),
            number<T>(0)};
        store_lanes(&found[k], reflected_weight(reflection, light, n, from_origin));
    }
    for (std::size_t k = 0; k < LightTree::width; ++k) weights[k] = static_cast<double>(found[k]);
}

/// A part whose doubt is at most this share of its weight, and which stands well apart from the
/// point and its horizon, is even: lights in it are drawn by power alone.
inline constexpr double even_doubt = 0.015;

/// What the parts of a group are worth, as far as one can say without a look into them: positive
/// where a light of theirs may be above the horizon. doubts: how much the lights within a part
/// differ, as a variance times the part's weight; 0 of an even one, if any may be. docs/theory.md,
/// eqs. 66 to 69.
template <class T, class Reflection>
MIS_OWN_COPY void weigh_parts(const Reflection& reflection, const TreePoint<Scalar<T>>& at,
                              const LightTree::NodeGroup& group, LightRow& weights,
                              LightTree::Row<Scalar<T>>& doubts, bool may_be_even = true)
{
    using std::sqrt;
    using S = Scalar<T>;
    const T zero = number<T>(0), one = number<T>(1), least = number<T>(1e-36);
    const Vec3<T> n{T(at.point.n.x), T(at.point.n.y), T(at.point.n.z)};
    const T from_origin(length(at.point.x));
    const T rounding = number<T>(64) * T(std::numeric_limits<S>::epsilon());
    const T least_even = may_be_even ? number<T>(even_doubt) : number<T>(-1);
    const T unit(static_cast<S>(at.inverse_unit));
    const Vec3<S> x = vec_cast<S>((at.x - group.origin) * at.inverse_unit);
    const auto lengths = [&](const LightTree::Row<float>& row, std::size_t k)
        __attribute__((always_inline))
    {
        return T(detail::lanes_of_row<T>(row, k) * unit);
    };
    alignas(64) LightTree::Row<S> found;  // NOLINT: filled at once
    for (std::size_t k = 0; k < LightTree::width; k += lane_count<T>) {
        const Vec3<T> to_middle{T(lengths(group.x, k) - T(x.x)), T(lengths(group.y, k) - T(x.y)),
                                T(lengths(group.z, k) - T(x.z))};
        const Vec3<T> s{lengths(group.sx, k), lengths(group.sy, k), lengths(group.sz, k)};
        const T reach = lengths(group.reach, k), power = detail::lanes_of_row<T>(group.power, k);
        const T spread2 = dot(s, s), d2 = dot(to_middle, to_middle), d = sqrt(d2);
        const T inverse = one / sqrt(max_of(T(d2 + spread2), least));

        const Vec3<T> ns = n * s;
        const T height = dot(n, to_middle), variance = dot(ns, ns);
        const T root = sqrt(height * height + variance);
        const T rise = number<T>(0.5) * select(height > zero, T(height + root),
                                               T(variance / max_of(T(root - height), least)));
        // Of a thin layer around the point, few lights are near, but high, and all that counts.
        const T least_cos = select(d <= reach, number<T>(0.5), number<T>(1e-6));
        const T cos_theta = max_of(T(rise * inverse), least_cos);
        const auto is_above = height + reach > -rounding * (d + from_origin);
        const T irradiance =
            power * inverse * (select(is_above, T(T(pi<T>) * cos_theta), zero) * inverse);

        const T spread = spread2 * inverse * inverse, inverse_d = one / max_of(d, least);
        const SpreadReflected<T> reflected = reflection.of_spread(
            Vec3<T>(to_middle * inverse_d), T(spread * number<T>(1.0 / 3)), T(reach * inverse_d));
        const T weight = irradiance * (reflected.flat + reflected.lobe);
        store_lanes(&found[k], weight);
        const T uneven =
            spread + min_of(T(variance / max_of(T(rise * rise), least)), number<T>(1e4));
        const T doubt =
            irradiance * (reflected.flat * uneven +
                          reflected.lobe * (uneven + reflected.lobe_variance) + reflected.unsure);
        const auto is_even =
            doubt <= least_even * weight && d > number<T>(2) * reach && height > reach;
        // Amid the lights of a part, some may be far nearer than their mean square says. Such parts
        // come before all others; first those most of whose power stands apart from the rest, as a
        // sun's does amid lamps, the widest first.
        const auto is_amid = d <= reach && irradiance > zero;
        const auto may_be_near = d <= number<T>(2) * reach && d2 > number<T>(100) * spread2;
        const T near_first = select(may_be_near || is_amid, T(doubt * number<T>(1e12)), doubt);
        const T first = select(is_amid && spread2 < number<T>(0.1) * (reach * reach),
                               T(reach * number<T>(1e30)), near_first);
        store_lanes(&doubts[k], T(select(is_even, zero, first)));
    }
    for (std::size_t k = 0; k < LightTree::width; ++k) weights[k] = static_cast<double>(found[k]);
}

/// The same of an even part, or of its lights: their powers.
MIS_INLINE void take_powers(const LightTree::NodeGroup& group, LightRow& weights)
{
    for (std::size_t k = 0; k < LightTree::width; ++k)
        weights[k] = static_cast<double>(group.power[k]);
}
MIS_INLINE void take_powers(const LightTree::LightGroup& group, LightRow& weights)
{
    for (std::size_t k = 0; k < LightTree::width; ++k)
        weights[k] = group.luminance_radius[k] * group.radius[k];
}

}  // namespace mis
