#pragma once

#include "mis/engine/job.h"

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

/// The direction of a light draw without the rounding to T: axis in double, plus the offset.
template <class T>
MIS_INLINE Vec3<double> exact_direction(const TileJob<T>& job, const Batch<T>& batch, int row)
{
    const Light& light =
        (*job.lights)[static_cast<std::size_t>(batch.light[static_cast<std::size_t>(row)])];
    return normalized(normalized(light.center - shading_point(job, batch, row).x) +
                      vec_cast<double>(batch.offset.at(row)));
}

/// Where a light draw meets its own light; at the rim, where rounding may miss it, the nearest
/// point of the ray.
template <class T>
MIS_INLINE LightHit own_hit(const TileJob<T>& job, const Batch<T>& batch, int row,
                            const Vec3<double>& wi)
{
    const LightIndex j = batch.light[static_cast<std::size_t>(row)];
    const Light& light = (*job.lights)[static_cast<std::size_t>(j)];
    const Vec3<double> to_center = light.center - shading_point(job, batch, row).x;
    const double distance = hit_distance(to_center, light.radius, wi);
    return {j, distance < std::numeric_limits<double>::infinity() ? distance : dot(to_center, wi)};
}

}  // namespace mis
