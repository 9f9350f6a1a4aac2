#pragma once

#include "mis/engine/rows.h"
#include "mis/sampling/philox_lanes.h"
#include "mis/sampling/sobol.h"

namespace mis {
inline namespace MIS_ISA {

// The random numbers of one draw of every row, in lanes of rows of one point.

/// put(row, words) for lanes of rows: each random word of the block as low halves. Lanes may reach
/// into the rows behind, which are put again then.
template <class T, class Put>
MIS_INLINE void scramble_rows(const TileJob<T>& job, const Batch<T>& batch, Block block,
                              const Put& put)
{
    using P = PhiloxLanes;
    alignas(64) Column<std::uint64_t> of_rows;  // NOLINT: filled as far as it is read
    if (!batch.rows_are_samples)
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i)
            of_rows[i] = sample_of(batch, i);
    const std::uint64_t* samples =
        batch.rows_are_samples ? batch.sample_number.data() : of_rows.data();
    for_each_run(
        batch, [&](int first, int end) __attribute__((always_inline)) {
            const std::uint32_t id = shading_point(job, batch, first).id;
            const auto begin = static_cast<std::size_t>(first),
                       last = static_cast<std::size_t>(end);
            const auto alike = [&](std::size_t i) __attribute__((always_inline))
            {
                return AlikeCounters(job.numbers.seed,
                                     counter_words({id, samples[i], batch.draw}, block));
            };
            std::uint64_t apart = 0;
            for (std::size_t i = begin; i < last; ++i) apart |= samples[i] ^ samples[begin];
            if (apart >> 32 == 0) {
                const AlikeCounters counters = alike(begin);
                for (std::size_t i = begin; i < last; i += P::count)
                    put(i, counters.scrambled(P::load(&samples[i])));
            } else {
                for (std::size_t i = begin; i < last; ++i)
                    put(i, alike(i).scrambled(P::all(samples[i])));
            }
        });
}

/// → bits, u, v.
template <class T> void light_numbers(const TileJob<T>& job, Batch<T>& batch)
{
    using P = PhiloxLanes;
    Column<std::uint32_t> u, v;  // NOLINT: filled as far as they are read
    scramble_rows(
        job, batch,
        Block::light, [&](std::size_t i, const auto& words) __attribute__((always_inline)) {
            P::store(&batch.bits[i], P::low_halves(words.a, words.b));
            P::store_low_halves(&u[i], words.c), P::store_low_halves(&v[i], words.d);
        });
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i)
        batch.u[i] = unit_number<T>(u[i]), batch.v[i] = unit_number<T>(v[i]);
}

/// → lobe, u, v.
template <class T> void bsdf_numbers(const TileJob<T>& job, Batch<T>& batch)
{
    using P = PhiloxLanes;
    Column<std::uint32_t> lobe, u, v;  // NOLINT: filled as far as they are read
    scramble_rows(
        job, batch,
        Block::bsdf, [&](std::size_t i, const auto& words) __attribute__((always_inline)) {
            P::store_low_halves(&lobe[i], words.b);
            P::store_low_halves(&u[i], words.c), P::store_low_halves(&v[i], words.d);
        });
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i) {
        batch.lobe[i] = unit_number<T>(lobe[i]);
        batch.u[i] = unit_number<T>(u[i]);
        batch.v[i] = unit_number<T>(v[i]);
    }
}

/// Of every row its point in the sequence, and the key of one dimension's scrambling each.
struct SequenceColumns {
    alignas(64) Column<std::uint32_t> index;
    alignas(64) std::array<Column<std::uint32_t>, 4> key;
};

/// How a half's draws spend its sequences: draw `draw` of `draws` per sample of sequence `stream`.
struct SequenceUse {
    std::uint32_t stream, draws, draw;
};

/// Rows of one point and scrambling stand together mostly, so that keys are made once for them all.
template <class T>
void gather_sequence_points(const TileJob<T>& job, const Batch<T>& batch, Block block,
                            const SequenceUse& use, SequenceColumns& columns)
{
    std::uint32_t last_id = 0;
    SequencePoint last{};
    Words keys{};
    for (int row = 0; row < batch.rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        const std::uint64_t sample = batch.sample_number[static_cast<std::size_t>(batch.slot[i])];
        const std::uint32_t id = shading_point(job, batch, row).id;
        const SequencePoint at =
            SequencePoint::of(job.numbers.samples_per_scrambling, sample, use.draws, use.draw);
        if (row == 0 || id != last_id || at.scrambling != last.scrambling ||
            at.index >> 32 != last.index >> 32) {
            keys = scrambling_keys(job.numbers.seed, id, at, use.stream, block);
            last_id = id, last = at;
        }
        columns.index[i] = static_cast<std::uint32_t>(at.index);
        for (std::size_t k = 0; k < 4; ++k) columns.key[k][i] = keys[k];
    }
}

/// One dimension's numbers of all rows, over 2³². Plain loops, which compilers turn into lanes:
/// bits of the index that no row has cost nothing.
template <Dimension dimension>
void sobol_words(int rows, const Column<std::uint32_t>& index, const Column<std::uint32_t>& key,
                 Column<std::uint32_t>& word)
{
    const auto count = static_cast<std::size_t>(rows);
    constexpr std::array<std::uint32_t, 32> columns = sobol_columns(dimension);
    std::uint32_t any = 0;
    for (std::size_t i = 0; i < count; ++i) any |= index[i];
    for (std::size_t i = 0; i < count; ++i) word[i] = 0;
    for (std::size_t bit = 0; bit < 32 && any >> bit != 0; ++bit)
        for (std::size_t i = 0; i < count; ++i)
            word[i] ^= columns[bit] & (0u - (index[i] >> bit & 1u));
    for (std::size_t i = 0; i < count; ++i) word[i] = owen_scrambled(word[i], key[i]);
}

/// light_numbers of a Sobol' sequence. The lower half of the choice's bits, which tells lights
/// apart where there are many, is random.
template <class T> void sobol_light_numbers(const TileJob<T>& job, Batch<T>& batch)
{
    Column<std::uint32_t> low;           // NOLINT: filled as far as it is read
    SequenceColumns at;                  // NOLINT
    Column<std::uint32_t> choice, u, v;  // NOLINT
    scramble_rows(
        job, batch,
        Block::light, [&](std::size_t i, const auto& words) __attribute__((always_inline)) {
            PhiloxLanes::store_low_halves(&low[i], words.b);
        });
    const std::uint32_t stream = job.draws_every_light ? batch.draw / job.draws_per_light : 0;
    gather_sequence_points(job, batch, Block::light,
                           {stream, job.draws_per_light, batch.draw % job.draws_per_light}, at);
    sobol_words<Dimension::choice>(batch.rows, at.index, at.key[key_of::choice], choice);
    sobol_words<Dimension::light_u>(batch.rows, at.index, at.key[key_of::light_u], u);
    sobol_words<Dimension::light_v>(batch.rows, at.index, at.key[key_of::light_v], v);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i) {
        batch.bits[i] = std::uint64_t{choice[i]} << 32 | low[i];
        batch.u[i] = unit_number<T>(u[i]);
        batch.v[i] = unit_number<T>(v[i]);
    }
}

/// bsdf_numbers of a Sobol' sequence.
template <class T> void sobol_bsdf_numbers(const TileJob<T>& job, Batch<T>& batch)
{
    SequenceColumns at;                // NOLINT: filled as far as it is read
    Column<std::uint32_t> lobe, u, v;  // NOLINT
    gather_sequence_points(job, batch, Block::bsdf, {0, job.bsdf_draws, batch.draw}, at);
    sobol_words<Dimension::lobe>(batch.rows, at.index, at.key[key_of::lobe], lobe);
    sobol_words<Dimension::bsdf_u>(batch.rows, at.index, at.key[key_of::bsdf_u], u);
    sobol_words<Dimension::bsdf_v>(batch.rows, at.index, at.key[key_of::bsdf_v], v);
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch.rows); ++i) {
        batch.lobe[i] = unit_number<T>(lobe[i]);
        batch.u[i] = unit_number<T>(u[i]);
        batch.v[i] = unit_number<T>(v[i]);
    }
}

}  // namespace MIS_ISA
}  // namespace mis
