#pragma once

#include "mis/math/vec.h"
#include "mis/sampling/sample_name.h"
#include "mis/scene/light.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mis {

/// How many samples a batch holds: its columns together fit the first-level cache.
inline constexpr int batch_capacity = 256;

/// Lanes may begin at any row: so many numbers stand behind the last one.
inline constexpr int lane_room = 16;

/// One quantity of all rows of a batch.
template <class T> using Column = std::array<T, batch_capacity + lane_room>;

/// A vector quantity: one column per component.
template <class T> struct VecColumn {
    alignas(64) Column<T> x, y, z;

    template <class V> MIS_INLINE Vec3<V> get(int row) const
    {
        const auto i = static_cast<std::size_t>(row);
        return {load_lanes<V>(&x[i]), load_lanes<V>(&y[i]), load_lanes<V>(&z[i])};
    }
    template <class V> MIS_INLINE void set(int row, const Vec3<V>& v)
    {
        const auto i = static_cast<std::size_t>(row);
        store_lanes(&x[i], v.x), store_lanes(&y[i], v.y), store_lanes(&z[i], v.z);
    }
    Vec3<T> at(int row) const { return get<T>(row); }
    void put(int row, const Vec3<T>& v) { set<T>(row, v); }
};

/// Room for the table that a policy leaves for one point; policies keep small trivially copyable
/// views.
struct alignas(16) TableSlot {
    std::array<std::byte, 48> bytes;
};

/// Some hundred samples of one tile, one array per quantity. A half (light draws, or BSDF draws)
/// runs over `rows` rows; a row belongs to the sample `slot`, to whose `value` it adds. Rows beyond
/// `rows`, up to the next multiple of the lanes, hold harmless numbers, so that stages need no
/// remainder.
template <class T> struct Batch {
    int samples = 0;                             ///< in this batch: slots 0 … samples − 1
    int rows = 0;                                ///< of the half that runs now
    std::uint32_t draw = 0;                      ///< number of the draw within the sample
    bool rows_are_samples = false;               ///< all of them, in order: start_rows() did so
    int runs = 0;                                ///< of rows of one point, while that holds
    std::size_t points = 0;                      ///< shading points that have a table here
    std::uint64_t invalid = 0, shadow_rays = 0;  ///< counted over all batches
    SampleName first_invalid;                    ///< where invalid > 0

    // Per sample.
    alignas(64) Column<std::int32_t> sample_point;  ///< which of the batch's points
    alignas(64) Column<std::uint64_t> sample_number;
    VecColumn<double> value;  ///< radiance, W·sr⁻¹·m⁻²: dim lights after a bright one must count

    // Per run.
    std::array<std::int32_t, batch_capacity> run_end;  ///< its last row + 1

    // Per point of this batch.
    std::array<TableSlot, batch_capacity> tables;
    std::array<std::uint32_t, batch_capacity> tile_point;  ///< its number in the tile

    // Per row.
    alignas(64) Column<std::int32_t> slot;
    alignas(64) Column<std::int32_t> point;  ///< which of the batch's points
    alignas(64) Column<std::int32_t> light;  ///< or no_light
    alignas(64) Column<std::uint64_t> bits;  ///< of the choice
    alignas(64) Column<T> u, v, lobe;        ///< in [0, 1)
    VecColumn<T> x;                          ///< relative to the job's origin; for screening alone
    VecColumn<T> n;                          ///< shading normal
    VecColumn<T> wo;                         ///< in the shading frame
    VecColumn<T> wi;                         ///< in scene axes
    VecColumn<T> offset;                     ///< of a light draw: wi − axis of the cap
    alignas(64) Column<T> cos_theta;         ///< n·wi as it was drawn; > 0 above the horizon
    VecColumn<T> to_center;                  ///< from x to the light's centre
    alignas(64) Column<T> radius, gap2;      ///< of the light; d² − r²
    alignas(64) Column<T> distance;          ///< along wi to the light
    alignas(64) Column<T> light_number;      ///< its place in the columns as a T, for screening
    /// Place + 1 of the one light that screening cannot rule out; 0: none is left, −1: several are.
    alignas(64) Column<T> candidate;
    alignas(64) Column<T> probability;  ///< P(j | point)
    alignas(64) Column<T> light_pdf,
        bsdf_pdf;           ///< P · pdf of the light technique; pdf of the other, per steradian
    VecColumn<T> radiance;  ///< what arrives: over the pdf of the cap for a light draw; see stages
    VecColumn<T> contribution;  ///< f cos θ, then the row's share of the estimate; 0 is dead
};

}  // namespace mis
