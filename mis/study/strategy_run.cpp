#include "mis/study/strategy_run.h"

#include "mis/math/limits.h"
#include "mis/stats/pool.h"
#include "mis/study/count_dependence.h"

#include <algorithm>
#include <cmath>

namespace mis {

StrategyRun::StrategyRun(const LitScene& scene, const StudyPoints& points, const Strategy& strategy,
                         const NumberSource& numbers, const StopToken& stop)
    : points_(&points), samples_per_observation_(mis::samples_per_observation(strategy, numbers)),
      ready_(scene, strategy, kernels<float>(), numbers, {}, stop),
      results_(points.shading.points.size()), tiles_(points.shading.tiles.size())
{
}

std::vector<TileTotals> StrategyRun::run_tiles(const Allocation& allocation, int chunks,
                                               std::span<const double> weights,
                                               std::vector<std::vector<ChunkTotals>>& totals,
                                               WorkspacePool<float>& workspaces,
                                               const AnyExecutor& executor, const StopToken& stop)
{
    const GBuffer& shading = points_->shading;
    std::vector<TileTotals> costs(shading.tiles.size());
    totals.assign(shading.tiles.size(), std::vector<ChunkTotals>(static_cast<std::size_t>(chunks)));
    const auto run_tile = [&](std::size_t t) {
        if (allocation[t] == 0) return;
        const Tile& tile = shading.tiles[t];
        const SampleRange range{tiles_[t].samples_per_point, allocation[t], chunks,
                                samples_per_observation_};
        TileJob<float> job =
            ready_.job(tile, std::span(shading.points).subspan(tile.first, tile.count));
        job.stop = &stop;
        workspaces.with([&](Workspace<float>& workspace) {
            costs[t] = workspace.run(
                job, ready_.pipeline(tile), range,
                std::span(results_).subspan(tile.first, tile.count),
                weights.empty() ? weights : weights.subspan(tile.first, tile.count), totals[t]);
        });
        tiles_[t].samples_per_point += range.samples();
        tiles_[t].cost.add(costs[t]);
    };
    try {
        stoppable(executor, stop).for_each(shading.tiles.size(), run_tile);
    } catch (const Stopped&) {
        if (samples_ == 0) forget();  // not even a first sample of every point
        return {};
    }
    for (std::size_t t = 0; t < points_->figure_tiles; ++t) samples_ += costs[t].samples;
    return costs;
}

void StrategyRun::forget()
{
    results_.assign(results_.size(), {});
    tiles_.assign(tiles_.size(), {});
    times_.clear();
    samples_ = 0;
}

bool StrategyRun::sample_round(const Round& round, std::span<const double> weights,
                               WorkspacePool<float>& workspaces, const AnyExecutor& executor,
                               const StopToken& stop)
{
    std::vector<std::vector<ChunkTotals>> totals;
    const std::vector<TileTotals> costs = run_tiles(round.allocation, round.end - round.first,
                                                    weights, totals, workspaces, executor, stop);
    if (costs.empty() && !tiles_.empty()) return false;
    for (std::size_t t = 0; t < tiles_.size(); ++t) {
        TileSums& tile = tiles_[t];
        tile.replicates.resize(static_cast<std::size_t>(round.replicates));
        const double n = round.allocation[t];
        for (std::size_t r = 0; r < totals[t].size(); ++r) {
            ReplicateSums& sums = tile.replicates[static_cast<std::size_t>(round.first) + r];
            sums.totals.mean += n * totals[t][r].mean;
            sums.totals.variance += (n - 1) * totals[t][r].variance;
            sums.totals.relative_variance += (n - 1) * totals[t][r].relative_variance;
            sums.observations += n;
            sums.degrees += n - 1;
        }
    }
    if (round.number) times_.push_back(observed(costs, *round.number));
    return true;
}

bool StrategyRun::sample_apart(const Apart& apart, WorkspacePool<float>& workspaces,
                               const AnyExecutor& executor, const StopToken& stop)
{
    const auto parts = static_cast<std::size_t>(apart.parts);
    const bool is_first = samples_ == 0;
    for (std::size_t part = 0; part < parts; ++part) {
        Allocation allocation(tiles_.size());
        for (std::size_t t = part; t < tiles_.size(); t += parts)
            allocation[t] = apart.observations;
        std::vector<std::vector<ChunkTotals>> totals;
        const std::vector<TileTotals> costs =
            run_tiles(allocation, 1, {}, totals, workspaces, executor, stop);
        if (costs.empty() && !tiles_.empty()) {
            if (is_first) forget();  // not even a first sample of every point
            return false;
        }
        if (parts > 1)
            times_.push_back(observed(costs, of_no_round + static_cast<std::uint32_t>(timed())));
        else if (apart.round) times_.push_back(observed(costs, *apart.round));
    }
    return true;
}

namespace {

double prepare_seconds(const TileTotals& t)
{
    return t.stage_seconds[static_cast<std::size_t>(StageKind::prepare)];
}

}  // namespace

/// The mean over the points that took part, not over the samples, which are more on some tiles than
/// on others.
TimeObservation StrategyRun::observed(std::span<const TileTotals> totals, std::uint32_t round) const
{
    TimeObservation sum;
    double points = 0;
    for (std::size_t t = 0; t < points_->figure_tiles; ++t) {
        if (totals[t].samples == 0) continue;
        const double of_tile = points_->shading.tiles[t].count;
        const double prepare = prepare_seconds(totals[t]);
        points += of_tile;
        sum.seconds_per_sample +=
            of_tile * (totals[t].seconds - prepare) / static_cast<double>(totals[t].samples);
        sum.seconds_per_point += prepare;
    }
    points = std::max(points, 1.0);
    return {sum.seconds_per_sample / points, sum.seconds_per_point / points, round};
}

namespace {

/// Number of the first sample that is tried out: no study has so many.
std::uint64_t first_tried_out(const Strategy& strategy)
{
    if (strategy.model != Model::strata) return std::uint64_t{1} << 40;
    return static_cast<std::uint64_t>(samples_together(strategy)) << 30;  // by observations
}

}  // namespace

TimeObservation StrategyRun::try_out(int samples, std::size_t points,
                                     WorkspacePool<float>& workspaces, const StopToken& stop) const
{
    TileTotals totals;
    std::size_t tried = 0;
    workspaces.with([&](Workspace<float>& workspace) {
        const std::size_t tiles = points_->shading.tiles.size();
        for (std::size_t k = 0; k < 4 && tried < points; ++k) {
            const Tile& tile = points_->shading.tiles[k * tiles / 4];
            const std::size_t count = std::min<std::size_t>(tile.count, points / 4 + 1);
            std::vector<PointResult> results(count);
            TileJob<float> job =
                ready_.job(tile, std::span(points_->shading.points).subspan(tile.first, count));
            job.stop = &stop;
            const int each = samples_together(strategy());
            totals.add(workspace.run(job, ready_.pipeline(tile),
                                     {.first = first_tried_out(strategy()),
                                      .chunk = (samples + each - 1) / each,
                                      .samples_per_observation = each},
                                     results, {}, {}));
            tried += count;
        }
    });
    const double prepare = prepare_seconds(totals);
    return {(totals.seconds - prepare) /
                static_cast<double>(std::max<std::uint64_t>(totals.samples, 1)),
            prepare / static_cast<double>(std::max<std::size_t>(tried, 1))};
}

std::optional<SampleName> StrategyRun::first_invalid() const
{
    for (const TileSums& tile : tiles_)
        if (tile.cost.invalid > 0) return tile.cost.first_invalid;
    return std::nullopt;
}

StrategyMeasurements StrategyRun::measurements(const RelativeScale& scale) const
{
    StrategyMeasurements m;
    m.strategy = strategy();
    std::vector<Moments> moments;
    moments.reserve(results_.size());
    for (const PointResult& result : results_) moments.push_back(result.luminance);
    for (const std::int64_t p : points_->probe_point)  // what is dark is 0 in every sample
        m.probes.push_back(p >= 0 ? moments[static_cast<std::size_t>(p)] : Moments{.count = 2});
    const auto figures = std::span<const Moments>(moments).first(points_->figure_lit);

    m.pooled =
        pool_points(figures, std::span<const double>(scale.squares).first(points_->figure_lit));
    m.pooled.relative_variance_doubt = relative_variance_doubt(figures, scale);
    const double lit = points_->figure_points == 0
                           ? 0
                           : double(points_->figure_lit) / double(points_->figure_points);
    m.pooled.mean *= lit;  // dark points have mean and variance 0
    m.pooled.variance *= lit;
    m.pooled.relative_variance *= lit;
    m.pooled.relative_variance_doubt *= lit;
    m.samples_per_observation = samples_per_observation_;
    m.pooled.samples *= static_cast<std::uint64_t>(samples_per_observation_);
    m.pooled.variance *= samples_per_observation_;  // docs/theory.md (70)
    m.pooled.relative_variance *= samples_per_observation_;
    m.pooled.relative_variance_doubt *= samples_per_observation_;
    m.region_participation.resize(points_->regions);
    for (std::size_t t = 0; t < points_->figure_tiles; ++t) {
        const Tile& tile = points_->shading.tiles[t];
        const Participation p = participation_of(figures.subspan(tile.first, tile.count));
        m.region_participation[points_->region_of(t)].sum_d2 += p.sum_d2;
        m.region_participation[points_->region_of(t)].sum_d4 += p.sum_d4;
    }
    add_replicates(m);
    add_costs(m);
    return m;
}

/// Means over the points, tile by tile: a tile that has more samples does not count more.
void StrategyRun::add_replicates(StrategyMeasurements& m) const
{
    if (points_->figure_tiles == 0 || tiles_.front().replicates.empty()) return;
    const double points = static_cast<double>(std::max<std::size_t>(points_->figure_points, 1));
    std::vector<double> region_points(points_->regions);
    for (std::size_t t = 0; t < points_->figure_tiles; ++t)
        region_points[points_->region_of(t)] += points_->shading.tiles[t].count;
    for (std::size_t r = 0; r < tiles_.front().replicates.size(); ++r) {
        if (tiles_.front().replicates[r].observations == 0) break;  // stopped before its turn
        ReplicateValues values;
        std::vector<double> region_means(points_->regions), region_variances(points_->regions);
        for (std::size_t t = 0; t < points_->figure_tiles; ++t) {
            const ReplicateSums& sums = tiles_[t].replicates[r];
            const double mean = sums.totals.mean / sums.observations;
            const double per_degree =
                sums.degrees > 0 ? samples_per_observation_ / (sums.degrees * points) : 0;
            values.mean += mean / points;
            values.variance += sums.totals.variance * per_degree;
            region_variances[points_->region_of(t)] += sums.totals.variance * per_degree;
            values.relative_variance += sums.totals.relative_variance * per_degree;
            region_means[points_->region_of(t)] += mean / region_points[points_->region_of(t)];
        }
        m.replicates.push_back(values);
        m.region_means.push_back(std::move(region_means));
        m.region_variances.push_back(std::move(region_variances));
    }
}

/// Per sample, in the mean over the points; times all samples, as the report divides by them.
void StrategyRun::add_costs(StrategyMeasurements& m) const
{
    m.times = times_;
    m.first_invalid = first_invalid().value_or(SampleName{});
    double rays = 0;
    for (std::size_t t = 0; t < points_->figure_tiles; ++t) {
        const TileTotals& cost = tiles_[t].cost;
        m.invalid_samples += cost.invalid;
        if (cost.samples == 0) continue;
        const double share = static_cast<double>(points_->shading.tiles[t].count) /
                             static_cast<double>(points_->figure_lit) *
                             static_cast<double>(samples_) / static_cast<double>(cost.samples);
        rays += share * static_cast<double>(cost.shadow_rays);
        for (std::size_t k = 0; k < stage_names.size(); ++k)
            if (cost.stage_seconds[k] > 0)
                m.stage_seconds[std::string(stage_names[k])] += share * cost.stage_seconds[k];
    }
    m.rays = static_cast<std::uint64_t>(std::llround(rays));
}

}  // namespace mis
