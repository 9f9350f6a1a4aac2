#pragma once

#include "mis/engine/rows.h"

namespace mis {
inline namespace MIS_ISA {

// Could a direction meet a light at all? All lights of a scene with few are seen from a point in
// lanes of lights, then lanes of its samples are held against each: with room for every rounding.
// What is ruled out here cannot meet one, what is not is tested in double by the hierarchy.

/// The lights as one point sees them, a little larger and nearer than they are.
template <class T> struct ScreenedLights {
    using OfEach = std::array<T, most_screened_lights>;
    alignas(64) OfEach x, y, z;  ///< of the unit direction to the centre
    alignas(64) OfEach cos_max;  ///< of the angle to it beyond which nothing meets the light
    alignas(64) OfEach nearest;  ///< no point of it is nearer; scene units
};

/// Positions relative to the tile's origin are rounded to T: by `slack` a centre may be beside. A
/// ray that meets the ball passes the centre as it is here by r + slack at most, so
/// sin θ ≤ (r + slack)/d. The cosine is taken below by more than what its own terms round by, and
/// than a direction's length is off: by that of a float in any number type, as points keep their
/// directions in float.
template <class V, class T>
MIS_INLINE void see_lights(const LightColumns<T>& lights, const Vec3<T>& point,
                           ScreenedLights<T>& seen)
{
    using std::abs, std::sqrt;
    const V epsilon(std::numeric_limits<T>::epsilon()), zero = number<V>(0), one = number<V>(1);
    const Vec3<V> x{V(point.x), V(point.y), V(point.z)};
    const V from_origin = abs(x.x) + abs(x.y) + abs(x.z);
    for (std::size_t k = 0; k < lights.count; k += lane_count<V>) {
        const Vec3<V> center{load_lanes<V>(&lights.x[k]), load_lanes<V>(&lights.y[k]),
                             load_lanes<V>(&lights.z[k])};
        const Vec3<V> to_center = center - x;
        const V between = abs(to_center.x) + abs(to_center.y) + abs(to_center.z);
        const V slack = (abs(center.x) + abs(center.y) + abs(center.z) + from_origin + between) *
                        (epsilon * number<V>(4));
        const V reach = load_lanes<V>(&lights.radius[k]) + slack;
        const V d = length(to_center);
        const V inverse = one / max_of(d, number<V>(1e-37));
        const V sin_max = reach * inverse;
        const V cos2 = one - sin_max * sin_max - epsilon * number<V>(8);
        const V cos_max = sqrt(max_of(cos2, zero)) - number<V>(2e-6);
        store_lanes(&seen.x[k], V(to_center.x * inverse));
        store_lanes(&seen.y[k], V(to_center.y * inverse));
        store_lanes(&seen.z[k], V(to_center.z * inverse));
        store_lanes(&seen.cos_max[k],
                    select(d > max_of(reach, number<V>(1e-18)), cos_max, number<V>(-2)));
        store_lanes(&seen.nearest[k], V(d * (one - epsilon * number<V>(8)) - reach));
    }
}

/// body(row, seen, wi) for lanes of each point's rows, after its lights were seen.
template <class V, class T, class Body>
MIS_INLINE void hold_against_lights(const TileJob<T>& job, const Batch<T>& batch, const Body& body)
{
    ScreenedLights<T> seen;  // NOLINT: filled as far as it is read
    for_each_run(
        batch, [&](int first, int end) __attribute__((always_inline)) {
            see_lights<V>(job.columns, batch.x.at(first), seen);
            for (int row = first; row < end; row += static_cast<int>(lane_count<V>))
                body(row, seen, batch.wi.template get<V>(row));
        });
}

/// Notes light k as candidate where `may_be`: its number + 1, or −1 beside another.
template <class V, class Condition>
MIS_INLINE void note_candidate(const Condition& may_be, std::size_t k, V& candidate)
{
    const V its(static_cast<Scalar<V>>(k + 1));
    candidate = select(may_be, V(select(candidate == number<V>(0), its, number<V>(-1))), candidate);
}

template <class V, class T>
MIS_INLINE auto may_meet(const ScreenedLights<T>& seen, std::size_t k, const Vec3<V>& wi)
{
    return V(seen.x[k]) * wi.x + V(seen.y[k]) * wi.y + V(seen.z[k]) * wi.z >= V(seen.cos_max[k]);
}

/// wi → candidate: which light could wi meet?
template <class V, class T> void screen_meeting(const TileJob<T>& job, Batch<T>& batch)
{
    hold_against_lights<V>(
        job, batch,
        [&](int row, const ScreenedLights<T>& seen, const Vec3<V>& wi)
            __attribute__((always_inline)) {
                V candidate = number<V>(0);
                for (std::size_t k = 0; k < job.columns.count; ++k)
                    note_candidate(may_meet(seen, k, wi), k, candidate);
                set_lanes(batch.candidate, row, candidate);
            });
}

/// wi, light, distance → candidate: which other light could stand before it?
template <class V, class T> void screen_hiding(const TileJob<T>& job, Batch<T>& batch)
{
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i)
        batch.light_number[i] = static_cast<T>(job.place_of(batch.light[i]));
    hold_against_lights<V>(
        job, batch,
        [&](int row, const ScreenedLights<T>& seen, const Vec3<V>& wi)
            __attribute__((always_inline)) {
                const V light = lanes_of<V>(batch.light_number, row);
                // Near the rim of a light, its distance is known to a thousandth of its radius.
                const V limit = lanes_of<V>(batch.distance, row) * number<V>(1 + 1e-5) +
                                lanes_of<V>(batch.radius, row) * number<V>(1e-3);
                V candidate = number<V>(0);
                for (std::size_t k = 0; k < job.columns.count; ++k)
                    note_candidate(may_meet(seen, k, wi) && V(seen.nearest[k]) <= limit &&
                                       light != V(static_cast<T>(k)),
                                   k, candidate);
                set_lanes(batch.candidate, row, candidate);
            });
}

}  // namespace MIS_ISA
}  // namespace mis
