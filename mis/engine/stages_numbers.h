#pragma once

#include "mis/engine/rows.h"
#include "mis/sampling/philox_lanes.h"

namespace mis {
inline namespace MIS_ISA {

// The random numbers of one draw of every row. Counters are gathered first, then scrambled in
// lanes; rows beyond the last scramble what was there.

struct WordColumns {
    alignas(64) Column<std::uint32_t> a, b, c, d;
};

template <class T>
void gather_counters(const TileJob<T>& job, const Batch<T>& batch, Block block, WordColumns& words)
{
    for (int row = 0; row < batch.rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        const std::uint64_t sample = batch.sample_number[static_cast<std::size_t>(batch.slot[i])];
        const Words start =
            counter_words({shading_point(job, batch, row).id, sample, batch.draw}, block);
        words.a[i] = start[0], words.b[i] = start[1], words.c[i] = start[2], words.d[i] = start[3];
    }
}

inline void scramble(std::uint64_t seed, int rows, WordColumns& words)
{
    for (std::size_t i = 0; i < static_cast<std::size_t>(rows); i += PhiloxLanes::count)
        scramble_lanes(seed, {&words.a[i], &words.b[i], &words.c[i], &words.d[i]});
}

/// → bits, u, v.
template <class T> void light_numbers(const TileJob<T>& job, Batch<T>& batch)
{
    WordColumns words;  // NOLINT: filled as far as it is read
    gather_counters(job, batch, Block::light, words);
    scramble(job.seed, batch.rows, words);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i) {
        batch.bits[i] = std::uint64_t{words.a[i]} << 32 | words.b[i];
        batch.u[i] = unit_number<T>(words.c[i]);
        batch.v[i] = unit_number<T>(words.d[i]);
    }
}

/// → lobe, u, v.
template <class T> void bsdf_numbers(const TileJob<T>& job, Batch<T>& batch)
{
    WordColumns words;  // NOLINT: filled as far as it is read
    gather_counters(job, batch, Block::bsdf, words);
    scramble(job.seed, batch.rows, words);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i) {
        batch.lobe[i] = unit_number<T>(words.b[i]);
        batch.u[i] = unit_number<T>(words.c[i]);
        batch.v[i] = unit_number<T>(words.d[i]);
    }
}

}  // namespace MIS_ISA
}  // namespace mis
