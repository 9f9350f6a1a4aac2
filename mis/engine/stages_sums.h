#pragma once

#include "mis/engine/kernels.h"
#include "mis/engine/rows.h"

#include <bit>
#include <type_traits>

namespace mis {
inline namespace MIS_ISA {

// What samples add up to. Plain loops, which compilers turn into lanes. channels: 3, or 1 where all
// three are the same and the first alone is added up.

/// Is any of these not finite, as its exponent says?
template <class T> MIS_INLINE bool any_not_finite(const VecColumn<T>& column, std::size_t count)
{
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    constexpr Bits infinity = std::bit_cast<Bits>(std::numeric_limits<T>::infinity());
    Bits any = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const T sum = column.x[i] + column.y[i] + column.z[i];
        any |= static_cast<Bits>((std::bit_cast<Bits>(sum) & infinity) == infinity);
    }
    return any != 0;
}

/// value[slot] += contribution, row by row; what is not finite is counted, and not added.
template <int channels, class T> void add_row_by_row(const TileJob<T>& job, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row) {
        const Vec3<T> contribution = batch.contribution.at(row);
        if (!std::isfinite(contribution.x + contribution.y + contribution.z)) {
            if (batch.invalid++ == 0)
                batch.first_invalid = {shading_point(job, batch, row).id,
                                       sample_of(batch, static_cast<std::size_t>(row))};
            continue;
        }
        const int slot = batch.slot[static_cast<std::size_t>(row)];
        if constexpr (channels == 1)
            batch.value.x[static_cast<std::size_t>(slot)] += static_cast<double>(contribution.x);
        else batch.value.put(slot, batch.value.at(slot) + vec_cast<double>(contribution));
    }
}

/// value[slot] += contribution; what is not finite is counted in `invalid`, and not added.
template <int channels, class T> void add_contributions(const TileJob<T>& job, Batch<T>& batch)
{
    const auto rows = static_cast<std::size_t>(batch.rows);
    if (!batch.rows_are_samples || any_not_finite(batch.contribution, rows)) {
        add_row_by_row<channels>(job, batch);
        return;
    }
    const auto add = [rows](Column<double> & sum, const Column<T>& more)
        __attribute__((always_inline))
    {
        for (std::size_t i = 0; i < rows; ++i) sum[i] += static_cast<double>(more[i]);
    };
    add(batch.value.x, batch.contribution.x);
    if constexpr (channels == 1) return;
    add(batch.value.y, batch.contribution.y);
    add(batch.value.z, batch.contribution.z);
}

/// The value of a sample, W·sr⁻¹·m⁻².
template <int channels, class T>
MIS_INLINE Vec3<double> value_of_sample(const Batch<T>& batch, std::size_t i)
{
    const double x = batch.value.x[i];
    return channels == 1 ? Vec3<double>(x) : Vec3<double>(x, batch.value.y[i], batch.value.z[i]);
}

template <int channels, class T>
void find_luminances(const Batch<T>& batch, Column<double>& luminances)
{
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.samples); ++i)
        luminances[i] = luminance(value_of_sample<channels>(batch, i));
}

/// The sum over samples goes on from `before`, one after the other: however samples are cut into
/// runs, it is the same to the bit.
template <int channels, class T>
RunSums sum_run(const Batch<T>& batch, int first, int end, std::span<const double> observed,
                double share, const Vec3<double>& before)
{
    RunSums sums{Moments::of(observed), before};
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(end); ++i)
        sums.radiance += share * value_of_sample<channels>(batch, i);
    return sums;
}

}  // namespace MIS_ISA
}  // namespace mis
