#pragma once

#include "mis/engine/rows.h"

namespace mis {
inline namespace MIS_ISA {

// Could a direction meet a light at all? Lanes of samples against every light of a scene with few,
// with room for every rounding: what is ruled out here cannot meet one, what is not is tested in
// double by the hierarchy.

/// Positions relative to the tile's origin and directions are rounded to T: the ray may pass this
/// much beside.
template <class V, class T>
MIS_INLINE V slack_of(const LightColumns<T>& lights, std::size_t k, const Vec3<V>& to_center,
                      const Vec3<V>& x)
{
    using std::abs;
    const V light = abs(V(lights.x[k])) + abs(V(lights.y[k])) + abs(V(lights.z[k]));
    const V point = abs(x.x) + abs(x.y) + abs(x.z);
    const V between = abs(to_center.x) + abs(to_center.y) + abs(to_center.z);
    return (light + point + between) * V(std::numeric_limits<T>::epsilon() * 4);
}

/// wi → candidate: could wi meet any light?
template <class V, class T> void screen_meeting(const TileJob<T>& job, Batch<T>& batch)
{
    const LightColumns<T>& lights = job.columns;
    const V zero = number<V>(0), one = number<V>(1);
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const Vec3<V> x = batch.x.template get<V>(row), wi = batch.wi.template get<V>(row);
        V candidate = zero;
        for (std::size_t k = 0; k < lights.count; ++k) {
            const Vec3<V> to_center = Vec3<V>{V(lights.x[k]), V(lights.y[k]), V(lights.z[k])} - x;
            const V slack = slack_of(lights, k, to_center, x), reach = V(lights.radius[k]) + slack;
            const V near = select(length2(cross(to_center, wi)) <= square(reach), one, zero);
            candidate = max_of(candidate, select(dot(to_center, wi) > -slack, near, zero));
        }
        set_lanes(batch.candidate, row, candidate);
    });
}

/// wi, light, distance → candidate: could another light stand before it?
template <class V, class T> void screen_hiding(const TileJob<T>& job, Batch<T>& batch)
{
    const LightColumns<T>& lights = job.columns;
    const V zero = number<V>(0), one = number<V>(1);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i)
        batch.light_number[i] = static_cast<T>(job.place_of(batch.light[i]));
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const Vec3<V> x = batch.x.template get<V>(row), wi = batch.wi.template get<V>(row);
        const V light = lanes_of<V>(batch.light_number, row),
                distance = lanes_of<V>(batch.distance, row);
        V candidate = zero;
        for (std::size_t k = 0; k < lights.count; ++k) {
            const Vec3<V> to_center = Vec3<V>{V(lights.x[k]), V(lights.y[k]), V(lights.z[k])} - x;
            const V slack = slack_of(lights, k, to_center, x), reach = V(lights.radius[k]) + slack;
            const V along = dot(to_center, wi);
            V hides = select(length2(cross(to_center, wi)) <= square(reach), one, zero);
            hides = select(along > -slack, hides, zero);
            hides =
                select(along - reach <= distance + slack + distance * number<V>(1e-5), hides, zero);
            candidate = max_of(candidate, select(light == V(static_cast<T>(k)), zero, hides));
        }
        set_lanes(batch.candidate, row, candidate);
    });
}

}  // namespace MIS_ISA
}  // namespace mis
