#pragma once

#include "mis/policy/light_tree.h"
#include "mis/policy/seen_product.h"

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

/// What stands at places [first, …) of a group: from the point, in units.
template <class T, class Group>
MIS_INLINE Vec3<T> places_of(const Group& group, const TreePoint<Scalar<T>>& at, std::size_t first)
{
    return {lanes_of_row<T>(group.x, first, at.x.x, at.inverse_unit),
            lanes_of_row<T>(group.y, first, at.x.y, at.inverse_unit),
            lanes_of_row<T>(group.z, first, at.x.z, at.inverse_unit)};
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
        const Vec3<T> to_center = detail::places_of<T>(group, at, k);
        const SeenLight<T> light{
            to_center, length(to_center),
            detail::lanes_of_row<T>(group.radius, k, 0, at.inverse_unit),
            detail::lanes_of_row<T>(group.luminance_radius, k, 0, 1 / at.inverse_unit),
            number<T>(0)};
        store_lanes(&found[k], reflected_weight(reflection, light, n, from_origin));
    }
    for (std::size_t k = 0; k < LightTree::width; ++k) weights[k] = static_cast<double>(found[k]);
}

/// What the parts of a group are worth, as far as one can say without a look into them: positive
/// where a light of theirs may be above the horizon. doubts: how much the lights within a part
/// differ, as a variance times the part's weight. docs/theory.md, eqs. 66 to 69.
template <class T, class Reflection>
MIS_OWN_COPY void weigh_parts(const Reflection& reflection, const TreePoint<Scalar<T>>& at,
                              const LightTree::NodeGroup& group, LightRow& weights,
                              LightTree::Row<Scalar<T>>& doubts)
{
    using std::sqrt;
    const T zero = number<T>(0), one = number<T>(1), least = number<T>(1e-36);
    const Vec3<T> n{T(at.point.n.x), T(at.point.n.y), T(at.point.n.z)};
    const T from_origin(length(at.point.x));
    const T rounding = number<T>(64) * T(std::numeric_limits<Scalar<T>>::epsilon());
    const double unit2 = at.inverse_unit * at.inverse_unit;
    alignas(64) LightTree::Row<Scalar<T>> found;  // NOLINT: filled at once
    for (std::size_t k = 0; k < LightTree::width; k += lane_count<T>) {
        const Vec3<T> to_middle = detail::places_of<T>(group, at, k);
        const T xx = detail::lanes_of_row<T>(group.xx, k, 0, unit2),
                yy = detail::lanes_of_row<T>(group.yy, k, 0, unit2),
                zz = detail::lanes_of_row<T>(group.zz, k, 0, unit2),
                reach = detail::lanes_of_row<T>(group.reach, k, 0, at.inverse_unit),
                power = detail::lanes_of_row<T>(group.power, k, 0, 1);
        const T spread2 = xx + yy + zz, d = length(to_middle);
        const T inverse = one / sqrt(max_of(T(d * d + spread2), least));

        const T height = dot(n, to_middle),
                variance = n.x * n.x * xx + n.y * n.y * yy + n.z * n.z * zz;
        const T root = sqrt(height * height + variance);
        const T rise = number<T>(0.5) * select(height > zero, T(height + root),
                                               T(variance / max_of(T(root - height), least)));
        const T cos_theta = max_of(T(rise * inverse), number<T>(1e-6));
        const auto is_above = height + reach > -rounding * (d + from_origin);
        const T irradiance =
            power * inverse * (select(is_above, T(T(pi<T>) * cos_theta), zero) * inverse);

        const T spread = spread2 * inverse * inverse;
        const SpreadReflected<T> reflected = reflection.of_spread(
            Vec3<T>(to_middle * T(one / max_of(d, least))), T(spread * number<T>(1.0 / 3)));
        store_lanes(&found[k], T(irradiance * (reflected.flat + reflected.lobe)));
        const T uneven =
            spread + min_of(T(variance / max_of(T(rise * rise), least)), number<T>(1e4));
        const T doubt = irradiance * (reflected.flat * uneven +
                                      reflected.lobe * (uneven + reflected.lobe_variance));
        // Nearly all of the power is far away, as a sun's, but other lights may be near.
        const T first = select(d * d > number<T>(100) * spread2, T(doubt * number<T>(1e12)), doubt);
        store_lanes(&doubts[k], select(d <= number<T>(2) * reach, first, doubt));
    }
    for (std::size_t k = 0; k < LightTree::width; ++k) weights[k] = static_cast<double>(found[k]);
}

}  // namespace mis
