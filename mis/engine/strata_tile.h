#pragma once

#include "mis/engine/pipeline.h"
#include "mis/engine/strata_spread.h"
#include "mis/engine/tile.h"
#include "mis/learn/rounds.h"
#include "mis/sampling/random.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mis {

/// What `strata` keeps of the points of one tile while it draws. In float, 16 bytes per point and
/// light, and 12 per block of 4 × 4 pixels and light: 4.2 MiB at most, of 256 points amid 1024
/// lights. Beside it 16 bytes per draw of a round: 0.8 MiB at most.
template <class T> struct StrataMemory {
    LargeVector<T> share, expected, drawn, seen;         ///< [point][place]
    LargeVector<T> block_drawn, block_seen, block_mean;  ///< [block][place]
    LargeVector<T> tile_drawn, tile_seen, tile_mean;     ///< [place]
    std::vector<Vec3<double>> sum, estimate;             ///< [point] of a round, of all rounds
    std::vector<Spread> chunk;                           ///< [point] of the chunk at hand
    StrataSpread<T> spread;
    StrataColumns columns;
};

/// Runs `strata` over the points of a tile: every observation learns afresh, from its own rounds
/// alone, so that observations are independent. What a round sees counts from the next one on: the
/// same bits whoever runs the tile.
template <class T> class StrataTile {
public:
    /// job: with its columns. All are kept by reference; the batch is empty.
    StrataTile(const TileJob<T>& job, const Pipeline<T>& pipeline, Batch<T>& batch,
               StrataMemory<T>& memory, StageTicks& ticks);

    /// Workspace::run's. An observation has range.samples_per_observation light draws.
    void run(const SampleRange& range, std::span<PointResult> results,
             std::span<const double> weights, std::span<ChunkTotals> totals);

private:
    void clear_counts();
    void learn();
    void observe(std::uint64_t observation, std::span<const LearningRound> rounds);
    void light_half(std::uint64_t key, int draws);
    void bsdf_half(std::uint64_t key, int draws);
    void begin_point(std::size_t p);
    void add_light_row(const StratumDraw<T>& draw, const Words& keys, std::uint64_t sample);
    void begin_batch();
    void flush_light();
    void flush_bsdf();
    void take_in();
    void count_seen();
    void run_stages(const std::vector<NamedStage<T>>& stages);
    template <class Body> void timed(StageKind kind, const Body& body);

    std::size_t block_of(std::size_t p) const;
    std::span<T> row_of(LargeVector<T>& table, std::size_t i) const
    {
        return std::span(table).subspan(i * places_, places_);
    }

    TileJob<T> job_;
    const Pipeline<T>& pipeline_;
    Batch<T>& batch_;
    StrataMemory<T>& memory_;
    StageTicks& ticks_;
    std::size_t places_;                            ///< the lights, padded to a multiple of 16
    std::array<LightIndex, batch_capacity> place_;  ///< [row] of the light drawn
    std::array<T, batch_capacity> expected_;        ///< [row] draws of it
};

extern template class StrataTile<float>;
extern template class StrataTile<double>;

}  // namespace mis
