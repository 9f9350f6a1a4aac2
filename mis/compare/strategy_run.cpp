#include "mis/compare/strategy_run.h"

#include "mis/compare/pool.h"
#include "mis/engine/stopwatch.h"

#include <algorithm>
#include <chrono>

namespace mis {

StrategyRun::StrategyRun(const LitScene& scene, const StudyPoints& points, const Strategy& strategy, std::uint64_t seed)
    : points_(&points), ready_(scene, strategy, kernels<float>(), seed), results_(points.shading.points.size())
{
}

void StrategyRun::sample(int chunk, int chunks, bool is_round, std::span<const double> weights,
                         WorkspacePool<float>& workspaces, const AnyExecutor& executor)
{
    const auto start = std::chrono::steady_clock::now();
    const GBuffer& shading = points_->shading;
    std::vector<TileTotals> totals(shading.tiles.size());
    std::vector<std::vector<ChunkTotals>> chunk_totals(shading.tiles.size());
    executor.for_each(shading.tiles.size(), [&](std::size_t t) {
        const Tile& tile = shading.tiles[t];
        chunk_totals[t].resize(static_cast<std::size_t>(chunks));
        workspaces.with([&](Workspace<float>& workspace) {
            totals[t] = workspace.run(ready_.job(tile, std::span(shading.points).subspan(tile.first, tile.count)),
                                      ready_.pipeline(tile.material), {samples_, chunk, chunks},
                                      std::span(results_).subspan(tile.first, tile.count),
                                      weights.empty() ? weights : weights.subspan(tile.first, tile.count), chunk_totals[t]);
        });
    });
    TileTotals figures;  // over the points that count
    for (std::size_t t = 0; t < points_->figure_tiles; ++t) figures.add(totals[t]);
    totals_.add(figures);
    samples_ += static_cast<std::uint64_t>(chunk) * static_cast<std::uint64_t>(chunks);
    wall_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (is_round) take_round(chunk, chunks, chunk_totals, figures);
}

void StrategyRun::take_round(int chunk, int chunks, const std::vector<std::vector<ChunkTotals>>& chunk_totals,
                             const TileTotals& round)
{
    const auto replicates = static_cast<std::size_t>(chunks);
    replicate_sums_.resize(replicates);
    region_sums_.resize(replicates, std::vector<double>(points_->regions));
    const double n = chunk, points = static_cast<double>(std::max<std::size_t>(points_->figure_points, 1));
    for (std::size_t r = 0; r < replicates; ++r)
        for (std::size_t t = 0; t < points_->figure_tiles; ++t) {
            const ChunkTotals& sums = chunk_totals[t][r];
            replicate_sums_[r].mean += n * sums.mean / points;
            replicate_sums_[r].variance += (n - 1) * sums.variance / points;
            replicate_sums_[r].relative_variance += (n - 1) * sums.relative_variance / points;
            region_sums_[r][points_->region_of(t)] += n * sums.mean;
        }
    mean_weight_ += n;
    variance_weight_ += n - 1;
    const double prepare = round.stage_seconds[static_cast<std::size_t>(StageKind::prepare)];
    if (round.samples > 0)
        times_.push_back({(round.seconds - prepare) / static_cast<double>(round.samples),
                          prepare / static_cast<double>(std::max<std::size_t>(points_->figure_lit, 1))});
}

TimeObservation StrategyRun::try_out(int samples, std::size_t points, WorkspacePool<float>& workspaces) const
{
    TileTotals totals;
    std::size_t tried = 0;
    workspaces.with([&](Workspace<float>& workspace) {
        const std::size_t tiles = points_->shading.tiles.size();
        for (std::size_t k = 0; k < 4 && tried < points; ++k) {
            const Tile& tile = points_->shading.tiles[k * tiles / 4];
            const std::size_t count = std::min<std::size_t>(tile.count, points / 4 + 1);
            std::vector<PointResult> results(count);
            totals.add(workspace.run(ready_.job(tile, std::span(points_->shading.points).subspan(tile.first, count)),
                                     ready_.pipeline(tile.material), {std::uint64_t{1} << 40, samples, 1}, results, {}, {}));
            tried += count;
        }
    });
    const double prepare = totals.stage_seconds[static_cast<std::size_t>(StageKind::prepare)];
    return {(totals.seconds - prepare) / static_cast<double>(std::max<std::uint64_t>(totals.samples, 1)),
            prepare / static_cast<double>(std::max<std::size_t>(tried, 1))};
}

StrategyMeasurements StrategyRun::measurements(std::span<const double> scale) const
{
    StrategyMeasurements m;
    m.strategy = strategy();
    std::vector<Moments> moments;
    moments.reserve(results_.size());
    for (const PointResult& result : results_) moments.push_back(result.luminance);
    for (const std::int64_t p : points_->probe_point)
        m.probes.push_back(p >= 0 ? moments[static_cast<std::size_t>(p)] : Moments{});
    const auto figures = std::span<const Moments>(moments).first(points_->figure_lit);

    m.pooled = pool_points(figures, scale.first(points_->figure_lit));
    const double lit = points_->figure_points == 0 ? 0 : double(points_->figure_lit) / double(points_->figure_points);
    m.pooled.mean *= lit;  // dark points have mean and variance 0
    m.pooled.variance *= lit;
    m.pooled.relative_variance *= lit;

    for (const ReplicateValues& sums : replicate_sums_)
        m.replicates.push_back({sums.mean / mean_weight_, variance_weight_ > 0 ? sums.variance / variance_weight_ : 0,
                                variance_weight_ > 0 ? sums.relative_variance / variance_weight_ : 0});
    std::vector<double> region_points(points_->regions);
    std::vector<std::size_t> region_first(points_->regions + 1, points_->figure_lit);
    for (std::size_t t = points_->figure_tiles; t-- > 0;) {
        region_points[points_->region_of(t)] += points_->shading.tiles[t].count;
        region_first[points_->region_of(t)] = points_->shading.tiles[t].first;
    }
    for (const std::vector<double>& sums : region_sums_) {
        std::vector<double> means(points_->regions);
        for (std::size_t g = 0; g < means.size(); ++g) means[g] = sums[g] / (mean_weight_ * region_points[g]);
        m.region_means.push_back(std::move(means));
    }
    for (std::size_t g = 0; g < points_->regions; ++g)
        m.region_participation.push_back(
            participation_of(figures.subspan(region_first[g], region_first[g + 1] - region_first[g])));

    m.times = times_;
    for (std::size_t k = 0; k < stage_names.size(); ++k)
        if (totals_.stage_seconds[k] > 0) m.stage_seconds[std::string(stage_names[k])] = totals_.stage_seconds[k];
    m.rays = totals_.shadow_rays;
    m.invalid_samples = totals_.invalid;
    return m;
}

}  // namespace mis
