#include "mis/engine/strata_tile.h"

#include "mis/engine/gbuffer.h"
#include "mis/engine/rows.h"
#include "mis/engine/stages_trace.h"
#include "mis/engine/stopwatch.h"

#include <algorithm>
#include <new>

namespace mis {

namespace {

/// Blocks of neighbours in a tile: squares of so many pixels a side.
constexpr std::uint32_t block_side = 4, blocks_across = tile_side / block_side;
constexpr std::size_t blocks = std::size_t{blocks_across} * blocks_across;

/// Rounds of one observation have numbers of their own, and so have draws of one round.
constexpr std::uint64_t most_rounds = 64, most_draws = std::uint64_t{1} << 20;

/// What a round's numbers at one point go by: two offsets, two keys.
Words round_words(const NumberSource& numbers, std::uint32_t point, std::uint64_t round)
{
    constexpr std::uint64_t apart = 0x7374'7261'7461'0000u;  // "strata": no sample has such numbers
    return random_words(numbers.seed ^ apart, {point, round, 0}, Block::light);
}

}  // namespace

template <class T>
StrataTile<T>::StrataTile(const TileJob<T>& job, const Pipeline<T>& pipeline, Batch<T>& batch,
                          StrataMemory<T>& memory, StageTicks& ticks)
    : job_(job), pipeline_(pipeline), batch_(batch), memory_(memory), ticks_(ticks),
      places_((job.lights->size() + 15) / 16 * 16)
{
    const std::size_t points = job_.points.size();
    for (LargeVector<T>* table : {&memory_.share, &memory_.drawn, &memory_.seen})
        table->resize(points * places_);
    if (!pipeline_.bsdf.empty()) memory_.expected.resize(points * places_);
    for (LargeVector<T>* table : {&memory_.block_drawn, &memory_.block_seen, &memory_.block_mean})
        table->resize(blocks * places_);
    for (LargeVector<T>* table : {&memory_.tile_drawn, &memory_.tile_seen, &memory_.tile_mean})
        table->resize(places_);
    if (job_.numbers.is_sobol()) job_.numbers.samples_per_scrambling = most_draws;
    job_.light_count = T(1);
    job_.bsdf_draws = 1;
}

template <class T> template <class Body> void StrataTile<T>::timed(StageKind kind, const Body& body)
{
    const std::uint64_t before = ticks();
    body();
    ticks_[static_cast<std::size_t>(kind)] += ticks() - before;
}

template <class T> std::size_t StrataTile<T>::block_of(std::size_t p) const
{
    if (job_.picture_width == 0) return 0;
    const std::uint32_t id = job_.points[p].id;
    const std::uint32_t x = id % job_.picture_width, y = id / job_.picture_width;
    return y / block_side % blocks_across * blocks_across + x / block_side % blocks_across;
}

template <class T>
void StrataTile<T>::run(const SampleRange& range, std::span<PointResult> results,
                        std::span<const double> weights, std::span<ChunkTotals> totals)
{
    const std::size_t points = job_.points.size();
    timed(StageKind::prepare, [&] {
        for (std::size_t p = 0; p < points; ++p)
            pipeline_.strata->find_shares(job_, job_.points[p], row_of(memory_.share, p));
    });
    const auto each = static_cast<std::uint64_t>(range.samples_per_observation);
    const std::vector<LearningRound> rounds = learning_rounds(range.samples_per_observation);
    memory_.chunk.assign(points, {});
    for (int o = 0; o < range.observations(); ++o) {
        observe(range.first / each + static_cast<std::uint64_t>(o), rounds);
        const bool ends_chunk = (o + 1) % range.chunk == 0;
        ChunkTotals* total =
            totals.empty() ? nullptr : &totals[static_cast<std::size_t>(o / range.chunk)];
        for (std::size_t p = 0; p < points; ++p) {
            const Vec3<double> radiance = memory_.estimate[p] * job_.radiance_unit;
            const double y = luminance(radiance);
            results[p].luminance.merge(Moments::of(std::span(&y, 1)));
            results[p].radiance_sum += radiance;
            memory_.chunk[p].merge(Spread::of(std::span(&y, 1)));
            if (!ends_chunk) continue;
            if (total != nullptr) total->add(memory_.chunk[p], weights.empty() ? 0 : weights[p]);
            memory_.chunk[p] = {};
        }
    }
}

template <class T> void StrataTile<T>::clear_counts()
{
    for (LargeVector<T>* table : {&memory_.drawn, &memory_.seen, &memory_.block_drawn,
                                  &memory_.block_seen, &memory_.tile_drawn, &memory_.tile_seen})
        std::fill(table->begin(), table->end(), T(0));
}

template <class T> void StrataTile<T>::learn()
{
    const std::span<T> tile = memory_.tile_mean;
    pipeline_.strata->learn_tile({memory_.tile_drawn, memory_.tile_seen}, tile);
    for (std::size_t b = 0; b < blocks; ++b)
        pipeline_.strata->learn_block(
            {row_of(memory_.block_drawn, b), row_of(memory_.block_seen, b)}, tile,
            row_of(memory_.block_mean, b));
}

template <class T>
void StrataTile<T>::observe(std::uint64_t observation, std::span<const LearningRound> rounds)
{
    clear_counts();
    const std::size_t points = job_.points.size();
    memory_.estimate.assign(points, Vec3<double>(0));
    for (std::size_t r = 0; r < rounds.size(); ++r) {
        if (job_.stop != nullptr) job_.stop->check();
        const std::uint64_t key = observation * most_rounds + r;
        timed(StageKind::choose, [&] { learn(); });
        memory_.sum.assign(points, Vec3<double>(0));
        const int bsdf_draws = pipeline_.bsdf.empty() ? 0 : lobe_draws(rounds[r].draws);
        job_.bsdf_count = static_cast<T>(bsdf_draws);
        light_half(key, rounds[r].draws);
        if (bsdf_draws > 0) bsdf_half(key, bsdf_draws);
        for (std::size_t p = 0; p < points; ++p)
            memory_.estimate[p] += memory_.sum[p] * rounds[r].weight;
    }
}

template <class T> void StrataTile<T>::light_half(std::uint64_t key, int draws)
{
    begin_batch();
    for (std::size_t p = 0; p < job_.points.size(); ++p) {
        const Words words = round_words(job_.numbers, job_.points[p].id, key);
        timed(StageKind::choose, [&] {
            StrataParts<T>& parts = memory_.spread.room(places_, draws);
            pipeline_.strata->part_lights({row_of(memory_.share, p),
                                           {row_of(memory_.drawn, p), row_of(memory_.seen, p)},
                                           row_of(memory_.block_mean, block_of(p))},
                                          draws, parts);
            memory_.spread.spread(draws, {words[0] * 0x1p-32, words[1] * 0x1p-32});
            if (!pipeline_.bsdf.empty()) memory_.spread.write_expected(row_of(memory_.expected, p));
        });
        begin_point(p);
        std::uint64_t sample = key * most_draws;
        for (const StratumDraw<T>& draw : memory_.spread.draws()) {
            if (batch_.samples == batch_capacity) {
                flush_light();
                begin_batch();
                begin_point(p);
            }
            add_light_row(draw, words, sample++);
        }
    }
    flush_light();
}

template <class T> void StrataTile<T>::bsdf_half(std::uint64_t key, int draws)
{
    begin_batch();
    for (std::size_t p = 0; p < job_.points.size(); ++p) {
        begin_point(p);
        for (int k = 0; k < draws; ++k) {
            if (batch_.samples == batch_capacity) {
                flush_bsdf();
                begin_batch();
                begin_point(p);
            }
            const auto i = static_cast<std::size_t>(batch_.samples++);
            batch_.sample_point[i] = static_cast<std::int32_t>(batch_.points - 1);
            batch_.sample_number[i] = key * most_draws + static_cast<std::uint64_t>(k);
        }
    }
    flush_bsdf();
}

template <class T> void StrataTile<T>::begin_batch()
{
    batch_.samples = 0;
    batch_.points = 0;
    batch_.draw = 0;
    batch_.rows_are_samples = false;
}

/// The next samples are of this point.
template <class T> void StrataTile<T>::begin_point(std::size_t p)
{
    const std::size_t slot = batch_.points++;
    batch_.tile_point[slot] = static_cast<std::uint32_t>(p);
    if (!pipeline_.bsdf.empty())
        ::new (&batch_.tables[slot]) ExpectedDraws<T>{row_of(memory_.expected, p).data()};
}

template <class T>
void StrataTile<T>::add_light_row(const StratumDraw<T>& draw, const Words& keys,
                                  std::uint64_t sample)
{
    const auto i = static_cast<std::size_t>(batch_.samples++);
    batch_.sample_point[i] = static_cast<std::int32_t>(batch_.points - 1);
    batch_.sample_number[i] = sample;
    place_[i] = draw.place, expected_[i] = draw.expected;
    StrataColumns& columns = memory_.columns;
    columns.stratum[i] = draw.stratum, columns.number[i] = draw.number;
    columns.key_u[i] = keys[2], columns.key_v[i] = keys[3];
}

template <class T> void StrataTile<T>::flush_light()
{
    if (batch_.samples == 0) return;
    timed(StageKind::rows, [&] { start_rows(job_, batch_); });
    timed(StageKind::numbers, [&] {
        if (job_.numbers.is_sobol()) pipeline_.strata->numbers(memory_.columns, batch_);
        else pipeline_.independent_numbers(job_, batch_);
    });
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch_.samples); ++i) {
        batch_.light[i] = job_.light_at(place_[i]);
        batch_.probability[i] = expected_[i];
    }
    run_stages(pipeline_.light);
    count_seen();
    take_in();
}

template <class T> void StrataTile<T>::flush_bsdf()
{
    if (batch_.samples == 0) return;
    std::swap(job_.bsdf, job_.lobe);  // all draws are the lobe's
    run_stages(pipeline_.bsdf);
    std::swap(job_.bsdf, job_.lobe);
    take_in();
}

template <class T> void StrataTile<T>::run_stages(const std::vector<NamedStage<T>>& stages)
{
    if (job_.stop != nullptr) job_.stop->check();
    const auto samples = batch_.samples;
    std::fill_n(batch_.value.x.begin(), samples, 0.0);
    if (pipeline_.colour) {  // else the first channel is all that is read
        std::fill_n(batch_.value.y.begin(), samples, 0.0);
        std::fill_n(batch_.value.z.begin(), samples, 0.0);
    }
    for (const NamedStage<T>& stage : stages) timed(stage.kind, [&] { stage.run(job_, batch_); });
}

/// A draw has seen its light if it adds anything.
template <class T> void StrataTile<T>::count_seen()
{
    for (int row = 0; row < batch_.rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        const std::size_t p = batch_.tile_point[static_cast<std::size_t>(batch_.point[i])];
        const auto place = static_cast<std::size_t>(place_[i]);
        const bool is_seen = !is_zero(batch_.contribution, row);
        const std::size_t block = block_of(p);
        SeenCounts<T>{row_of(memory_.drawn, p), row_of(memory_.seen, p)}.add(place, is_seen);
        SeenCounts<T>{row_of(memory_.block_drawn, block), row_of(memory_.block_seen, block)}.add(
            place, is_seen);
        SeenCounts<T>{memory_.tile_drawn, memory_.tile_seen}.add(place, is_seen);
    }
}

template <class T> void StrataTile<T>::take_in()
{
    for (std::size_t i = 0; i < static_cast<std::size_t>(batch_.samples); ++i) {
        const std::size_t p = batch_.tile_point[static_cast<std::size_t>(batch_.sample_point[i])];
        const double x = batch_.value.x[i];
        memory_.sum[p] += pipeline_.colour ? Vec3<double>(x, batch_.value.y[i], batch_.value.z[i])
                                           : Vec3<double>(x);
    }
}

template class StrataTile<float>;
template class StrataTile<double>;

}  // namespace mis
