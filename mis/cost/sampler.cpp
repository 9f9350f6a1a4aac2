#include "mis/cost/sampler.h"

#include "mis/engine/kernels.h"

#include <algorithm>

namespace mis {
namespace {

constexpr std::size_t wanted_points = 65536;
constexpr std::size_t most_copies = 256, least_copies = 16;
constexpr int stream_bits = 40;  // of a sample's number are the sample's own

/// What one tile came to.
struct TileErrors {
    double squared_errors = 0, spreads = 0;
    Participation participation;
    TileTotals cost;
};

template <class T> class SamplerOf final : public CostSampler {
public:
    SamplerOf(const StudyGround& ground, const CostPoints& points, const CostReference& reference,
              const Strategy& strategy, bool is_sobol)
        : points_(points), reference_(reference), stop_(ground.stop),
          executor_(stoppable(ground.executor, ground.stop)),
          ready_(ground.scene, strategy, kernels<T>(),
                 {ground.seed, is_sobol ? std::uint64_t{1} << stream_bits : 0}, {}, ground.stop)
    {
    }

    CostReplicate run(std::uint64_t samples, std::uint64_t stream) override
    {
        const StudyPoints& study = points_.points;
        std::vector<TileErrors> tiles(study.figure_tiles);
        executor_.for_each(tiles.size(), [&](std::size_t t) {
            tiles[t] = run_tile(study.shading.tiles[t], samples, stream);
        });
        CostReplicate sum;
        sum.squared_errors.resize(study.regions);
        sum.spreads.resize(study.regions);
        TileTotals cost;
        for (std::size_t t = 0; t < tiles.size(); ++t) {
            sum.squared_errors[study.region_of(t)] +=
                tiles[t].squared_errors / static_cast<double>(study.figure_points);
            sum.spreads[study.region_of(t)] +=
                tiles[t].spreads / static_cast<double>(study.figure_points);
            sum.participation.sum_d2 += tiles[t].participation.sum_d2;
            sum.participation.sum_d4 += tiles[t].participation.sum_d4;
            cost.add(tiles[t].cost);
        }
        sum.seconds = cost.seconds / static_cast<double>(study.figure_lit);
        sum.invalid = cost.invalid;
        return sum;
    }

private:
    TileErrors run_tile(const Tile& tile, std::uint64_t samples, std::uint64_t stream)
    {
        std::vector<PointResult> results(tile.count);
        TileErrors sum;
        workspaces_.with([&](Workspace<T>& workspace) {
            TileJob<T> job = ready_.job(
                tile, std::span(points_.points.shading.points).subspan(tile.first, tile.count));
            job.stop = &stop_;
            sum.cost = workspace.run(job, ready_.pipeline(tile),
                                     {stream << stream_bits, static_cast<int>(samples), 1}, results,
                                     {}, {});
        });
        for (std::size_t i = 0; i < results.size(); ++i) {
            const std::size_t p = (tile.first + i) / points_.copies;
            const double d = results[i].luminance.mean - reference_.means[p];
            const double square = d == 0 ? 0 : d * d / reference_.scale.squares[p];
            const double m2 = results[i].luminance.m2;
            if (m2 > 0)
                sum.spreads += m2 / static_cast<double>(samples) / reference_.scale.squares[p];
            sum.squared_errors += square;
            sum.participation.sum_d2 += square;
            sum.participation.sum_d4 += square * square;
        }
        return sum;
    }

    const CostPoints& points_;
    const CostReference& reference_;
    StopToken stop_;
    AnyExecutor executor_;
    ReadyStrategy<T> ready_;
    WorkspacePool<T> workspaces_;
};

}  // namespace

CostPoints cost_points(const StudyPoints& points, bool has_camera)
{
    CostPoints repeated{points, 1};
    if (has_camera || points.figure_lit == 0) return repeated;
    repeated.copies = std::clamp(wanted_points / points.figure_lit, least_copies, most_copies);
    GBuffer& shading = repeated.points.shading;
    shading.points.clear();
    const auto probes = static_cast<std::uint32_t>(points.figure_points);
    for (Tile& tile : shading.tiles) {
        const ShadingPoint point = points.shading.points[tile.first];
        tile.first = static_cast<std::uint32_t>(shading.points.size());
        tile.count = static_cast<std::uint32_t>(repeated.copies);
        for (std::uint32_t k = 0; k < tile.count; ++k) {
            shading.points.push_back(point);
            shading.points.back().id = point.id + k * probes;
        }
    }
    repeated.points.figure_points *= repeated.copies;
    repeated.points.figure_lit *= repeated.copies;
    return repeated;
}

std::unique_ptr<CostSampler> make_sampler(const StudyGround& ground, const CostPoints& points,
                                          const CostReference& reference, const Strategy& strategy,
                                          Precision precision, bool is_sobol)
{
    if (precision == Precision::in_double)
        return std::make_unique<SamplerOf<double>>(ground, points, reference, strategy, is_sobol);
    return std::make_unique<SamplerOf<float>>(ground, points, reference, strategy, is_sobol);
}

}  // namespace mis
