#include "mis/engine/tile.h"

#include "mis/engine/light_columns.h"
#include "mis/engine/stopwatch.h"
#include "mis/engine/strata_tile.h"

#include <algorithm>
#include <numeric>

namespace mis {

void TileTotals::add(const TileTotals& other)
{
    for (std::size_t k = 0; k < stage_seconds.size(); ++k)
        stage_seconds[k] += other.stage_seconds[k];
    seconds += other.seconds;
    samples += other.samples;
    shadow_rays += other.shadow_rays;
    if (invalid == 0) first_invalid = other.first_invalid;
    invalid += other.invalid;
}

void ChunkTotals::add(const Spread& observations, double weight)
{
    const double of_one = observations.count > 1 ? observations.m2 / (observations.count - 1) : 0;
    mean += observations.mean;
    variance += of_one;
    relative_variance += of_one * weight;
}

template <class T> Workspace<T>::Workspace() : batch_(std::make_unique<Batch<T>>()) {}
template <class T> Workspace<T>::~Workspace() = default;

namespace {

/// Tables of a batch's points may take this much, so that they stay in the second-level cache; one
/// point always fits.
constexpr std::size_t scratch_bytes = std::size_t{1} << 20;

/// Large tables, of so many lights that these fit no cache, are made of some points together.
std::size_t scratch_bytes_for(std::size_t table_bytes)
{
    constexpr std::size_t together = 8, most = std::size_t{8} << 20;
    return std::max({scratch_bytes, table_bytes, std::min(together * table_bytes, most)});
}

}  // namespace

/// One run over a tile: fills batches with the samples of its points, in order, and takes their
/// values in.
template <class T> struct Workspace<T>::Run {
    const TileJob<T>& job;
    const Pipeline<T>& pipeline;
    const SampleRange& range;
    std::span<PointResult> results;
    std::span<const double> weights;
    std::span<ChunkTotals> totals;
    Batch<T>& batch;
    Scratch& scratch;
    Column<double>& luminances;
    StageTicks& stage_ticks;
    std::size_t prepared = 0;    ///< points of the batch that have their table
    Spread chunk;                ///< of the point and chunk at hand
    double observation_sum = 0;  ///< over the samples so far of the observation at hand

    void all()
    {
        const int samples = static_cast<int>(range.samples());
        for (std::size_t p = 0; p < job.points.size(); ++p) {
            if (scratch.left() < (batch.points - prepared + 1) * pipeline.table_bytes) flush();
            if (batch.samples == 0) clear_points();
            add_point(p);
            for (int s = 0; s < samples;) {
                if (batch.samples == batch_capacity) {
                    flush();
                    keep_last_point();
                }
                s += add_samples(s, samples);
            }
            if (batch.samples == batch_capacity) flush();
        }
        flush();
    }

    /// Of the last point's samples, from sample s on, as many as there is room for: how many that
    /// is.
    int add_samples(int s, int samples)
    {
        const int count = std::min(batch_capacity - batch.samples, samples - s);
        const auto slot = static_cast<std::ptrdiff_t>(batch.samples);
        std::fill_n(batch.sample_point.begin() + slot, count,
                    static_cast<std::int32_t>(batch.points - 1));
        std::iota(batch.sample_number.begin() + slot, batch.sample_number.begin() + slot + count,
                  range.first + static_cast<std::uint64_t>(s));
        batch.samples += count;
        return count;
    }

    void clear_points()
    {
        batch.points = prepared = 0;
        scratch.clear();
    }

    void add_point(std::size_t p)
    {
        const std::size_t slot = batch.points++;
        batch.tile_point[slot] = static_cast<std::uint32_t>(p);
        constexpr std::size_t ahead = 16;  // of 16 samples each, the next batch's
        if (p + ahead >= job.points.size()) return;
        __builtin_prefetch(&job.points[p + ahead]);
        __builtin_prefetch(&results[p + ahead], 1);
    }

    /// Tables for the points that have none.
    void prepare_points()
    {
        if (pipeline.prepare == nullptr) return;
        const std::uint64_t start = ticks();
        pipeline.prepare(job, batch, prepared, scratch);
        prepared = batch.points;
        stage_ticks[static_cast<std::size_t>(StageKind::prepare)] += ticks() - start;
    }

    /// The point whose samples go on in the next batch: its table stays where it is.
    void keep_last_point()
    {
        batch.tables[0] = batch.tables[batch.points - 1];
        batch.tile_point[0] = batch.tile_point[batch.points - 1];
        batch.points = prepared = 1;
    }

    void flush()
    {
        if (batch.samples == 0) {
            clear_points();
            return;
        }
        check_stop();
        prepare_points();
        std::fill_n(batch.value.x.begin(), batch.samples, 0.0);
        if (pipeline.colour) {  // else the first channel is all that is read
            std::fill_n(batch.value.y.begin(), batch.samples, 0.0);
            std::fill_n(batch.value.z.begin(), batch.samples, 0.0);
        }
        const std::size_t lights = pipeline.draws_every_light ? job.lights->size() : 1;
        const std::uint32_t light_draws = static_cast<std::uint32_t>(pipeline.light_draws * lights);
        for (std::uint32_t draw = 0; draw < light_draws; ++draw) {
            if (draw % draws_between_looks == 0) check_stop();
            if (!is_below(draw)) run_half(pipeline.light, draw);
        }
        for (int draw = 0; draw < pipeline.bsdf_draws; ++draw)
            run_half(pipeline.bsdf, static_cast<std::uint32_t>(draw));
        take_in();
        batch.samples = 0;
        batch.rows_are_samples = false;
    }

    static constexpr std::uint32_t draws_between_looks = 16;

    void check_stop() const
    {
        if (job.stop != nullptr) job.stop->check();
    }

    /// Does a draw go to one light for all samples, which no point of the tile sees?
    bool is_below(std::uint32_t draw) const
    {
        return pipeline.draws_every_light &&
               job.knows(static_cast<LightIndex>(draw / job.draws_per_light), below);
    }

    void run_half(const std::vector<NamedStage<T>>& stages, std::uint32_t draw)
    {
        batch.draw = draw;
        std::uint64_t before = ticks();
        for (const NamedStage<T>& stage : stages) {
            stage.run(job, batch);
            const std::uint64_t now = ticks();
            stage_ticks[static_cast<std::size_t>(stage.kind)] += now - before;
            before = now;
        }
    }

    /// The values of the batch → moments, one run of samples of a point after the other.
    void take_in()
    {
        pipeline.sums.find_luminances(batch, luminances);
        if (job.radiance_unit != 1)
            for (int i = 0; i < batch.samples; ++i)
                luminances[static_cast<std::size_t>(i)] *= job.radiance_unit;
        const double share = job.radiance_unit / range.samples_per_observation;
        for (std::size_t first = 0; first < static_cast<std::size_t>(batch.samples);) {
            const std::int32_t slot = batch.sample_point[first];
            std::size_t end = first + 1;
            while (end < static_cast<std::size_t>(batch.samples) && batch.sample_point[end] == slot)
                ++end;
            const std::size_t point = batch.tile_point[static_cast<std::size_t>(slot)];
            const std::span<const double> observed = observations(first, end);
            const RunSums sums =
                pipeline.sums.sum_run(batch, static_cast<int>(first), static_cast<int>(end),
                                      observed, share, results[point].radiance_sum);
            results[point].luminance.merge(sums.luminance);
            results[point].radiance_sum = sums.radiance;
            if (!totals.empty()) add_to_chunks(point, first, observed);
            first = end;
        }
    }

    /// The observations that end with one of the samples [first, end) of the batch, which are of
    /// one point. One may have begun in the batch before.
    std::span<const double> observations(std::size_t first, std::size_t end)
    {
        const auto samples = std::span<double>(luminances).subspan(first, end - first);
        const auto each = static_cast<std::uint64_t>(range.samples_per_observation);
        if (each == 1) return samples;
        std::uint64_t taken = (batch.sample_number[first] - range.first) % each;
        std::size_t count = 0;
        for (const double x : samples) {
            observation_sum += x;
            if (++taken < each) continue;
            samples[count++] = observation_sum / static_cast<double>(each);
            observation_sum = 0, taken = 0;
        }
        return samples.first(count);
    }

    /// Observations of one point, the first of which ends at or after sample `first` of the batch,
    /// one chunk after the other.
    void add_to_chunks(std::size_t point, std::size_t first, std::span<const double> observed)
    {
        const auto size = static_cast<std::size_t>(range.chunk);
        auto number = static_cast<std::size_t>(batch.sample_number[first] - range.first) /
                      static_cast<std::size_t>(range.samples_per_observation);
        while (!observed.empty()) {
            const std::size_t count = std::min(size - number % size, observed.size());
            chunk.merge(Spread::of(observed.first(count)));
            observed = observed.subspan(count), number += count;
            if (number % size == 0) end_chunk(point, number / size - 1);
        }
    }

    void end_chunk(std::size_t point, std::size_t number)
    {
        totals[number].add(chunk, weights.empty() ? 0 : weights[point]);
        chunk = {};
    }
};

template <class T>
TileTotals Workspace<T>::run(TileJob<T> job, const Pipeline<T>& pipeline, const SampleRange& range,
                             std::span<PointResult> results, std::span<const double> weights,
                             std::span<ChunkTotals> totals)
{
    const double start = thread_seconds();
    const std::uint64_t start_ticks = ticks();
    if (!scratch_ || scratch_->size() < scratch_bytes_for(pipeline.table_bytes))
        scratch_ = std::make_unique<Scratch>(scratch_bytes_for(pipeline.table_bytes));
    if (pipeline.reads_all_lights || job.lights->size() <= most_screened_lights)
        job.columns =
            fill_light_columns(*job.lights, job.origin, columns_, job.order, job.radiance_scale);
    batch_->samples = 0;
    batch_->points = 0;
    batch_->rows_are_samples = false;
    batch_->invalid = batch_->shadow_rays = 0;
    scratch_->clear();
    StageTicks stage_ticks{};
    stage_ticks[static_cast<std::size_t>(StageKind::prepare)] =
        pipeline.reads_all_lights ? ticks() - start_ticks : 0;
    if (pipeline.strata != nullptr) {
        if (!strata_) strata_ = std::make_unique<StrataMemory<T>>();
        StrataTile<T>(job, pipeline, *batch_, *strata_, stage_ticks)
            .run(range, results, weights, totals);
    } else {
        Run{job,    pipeline, range,     results,    weights,
            totals, *batch_,  *scratch_, luminance_, stage_ticks}
            .all();
    }

    TileTotals result;
    const double all_ticks = static_cast<double>(std::max<std::uint64_t>(ticks() - start_ticks, 1));
    result.seconds = thread_seconds() - start;
    for (std::size_t k = 0; k < stage_ticks.size(); ++k)
        result.stage_seconds[k] = static_cast<double>(stage_ticks[k]) / all_ticks * result.seconds;
    result.samples = job.points.size() * range.samples();
    result.shadow_rays = batch_->shadow_rays;
    result.invalid = batch_->invalid;
    result.first_invalid = batch_->first_invalid;
    return result;
}

template class Workspace<float>;
template class Workspace<double>;

}  // namespace mis
