#pragma once

#include "mis/engine/draw.h"
#include "mis/engine/job.h"
#include "mis/math/frame.h"

#include <algorithm>
#include <cstring>

namespace mis {

/// body(row) for the first row of every group of lanes; V is the batch of lanes, or a plain number.
template <class V, class Body> MIS_INLINE void for_each_lane_group(int rows, const Body& body)
{
    for (int row = 0; row < rows; row += static_cast<int>(lane_count<V>)) body(row);
}

/// Lanes [row, row + lane_count) of a column.
template <class V, class T> MIS_INLINE V lanes_of(const Column<T>& column, int row)
{
    return load_lanes<V>(&column[static_cast<std::size_t>(row)]);
}
template <class V, class T> MIS_INLINE void set_lanes(Column<T>& column, int row, const V& value)
{
    store_lanes(&column[static_cast<std::size_t>(row)], value);
}

/// v where a condition holds, lane by lane; else 0.
template <class Condition, class T>
MIS_INLINE Vec3<T> zero_unless(const Condition& condition, const Vec3<T>& v)
{
    const T zero = number<T>(0);
    return {select(condition, v.x, zero), select(condition, v.y, zero),
            select(condition, v.z, zero)};
}

template <class T> MIS_INLINE bool is_zero(const VecColumn<T>& column, int row)
{
    const auto i = static_cast<std::size_t>(row);
    return column.x[i] == 0 && column.y[i] == 0 && column.z[i] == 0;
}

/// The table that `Policy` left for a point of the batch.
template <class Table, class T>
MIS_INLINE const Table& table_of(const Batch<T>& batch, std::int32_t point)
{
    static_assert(sizeof(Table) <= sizeof(TableSlot) && std::is_trivially_copyable_v<Table>);
    return *reinterpret_cast<const Table*>(&batch.tables[static_cast<std::size_t>(point)]);
}

template <class T>
MIS_INLINE const ShadingPoint& shading_point(const TileJob<T>& job, const Batch<T>& batch, int row)
{
    return job.points[batch.tile_point[static_cast<std::size_t>(
        batch.point[static_cast<std::size_t>(row)])]];
}

/// A shading point as policies see it.
template <class T>
MIS_INLINE ChoicePoint<T> choice_point(const TileJob<T>& job, const ShadingPoint& point)
{
    const Vec3<T> n = vec_cast<T>(point.n);
    return {vec_cast<T>(point.x - job.origin), n, frame_around(n).to_local(vec_cast<T>(point.wo)),
            AnyBsdf{job.bsdf, job.bsdf_type}, job.origin};
}

/// body(first, end) for each run of rows of one point.
template <class T, class Body> MIS_INLINE void for_each_run(const Batch<T>& batch, const Body& body)
{
    for (int run = 0, first = 0; first < batch.rows; ++run) {
        int end = first + 1;
        if (batch.rows_are_samples) {
            end = batch.run_end[static_cast<std::size_t>(run)];
        } else {
            const std::int32_t point = batch.point[static_cast<std::size_t>(first)];
            while (end < batch.rows && batch.point[static_cast<std::size_t>(end)] == point) ++end;
        }
        body(first, end);
        first = end;
    }
}

/// Number of a row's sample.
template <class T> MIS_INLINE std::uint64_t sample_of(const Batch<T>& batch, std::size_t row)
{
    return batch.sample_number[static_cast<std::size_t>(batch.slot[row])];
}

/// wi in double and of length 1. As a float it is 6e-8 too long or too short, by which rays along
/// the edge of a light that fills half the sky, 2e-4 rad of it, would miss it.
template <class T> MIS_INLINE Vec3<double> unit_direction(const Batch<T>& batch, int row)
{
    return normalized(vec_cast<double>(batch.wi.at(row)));
}

/// From a row's point to the centre of its light.
template <class T>
MIS_INLINE Vec3<double> to_light(const TileJob<T>& job, const Batch<T>& batch, int row)
{
    return job.light(batch.light[static_cast<std::size_t>(row)]).center -
           shading_point(job, batch, row).x;
}

/// That of a row's light draw.
template <class T>
MIS_INLINE Vec3<double> exact_direction(const TileJob<T>& job, const Batch<T>& batch, int row)
{
    return exact_direction(to_light(job, batch, row), vec_cast<double>(batch.offset.at(row)));
}

/// That of a row's light draw along wi.
template <class T>
MIS_INLINE LightHit own_hit(const TileJob<T>& job, const Batch<T>& batch, int row,
                            const Vec3<double>& wi)
{
    const LightIndex j = batch.light[static_cast<std::size_t>(row)];
    return own_hit(j, to_light(job, batch, row), job.light(j).radius, wi);
}

}  // namespace mis
