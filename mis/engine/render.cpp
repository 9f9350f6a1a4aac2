#include "mis/engine/render.h"

#include <algorithm>
#include <limits>

namespace mis {

Band find_band(const LitScene& scene, int first_row, int rows, const AnyExecutor& executor)
{
    Band band{find_shading_points(scene.scene(), scene.lights(), scene.surfaces(), first_row, rows,
                                  executor),
              {}};
    scene.plan(band.shading, executor);
    band.results.resize(band.shading.points.size());
    return band;
}

TileTotals light_band(const ReadyStrategy<float>& strategy, Band& band, std::uint64_t first,
                      int count, WorkspacePool<float>& workspaces, const AnyExecutor& executor,
                      const StopToken& stop)
{
    const GBuffer& shading = band.shading;
    const int each = band.samples_per_observation = samples_together(strategy.strategy());
    const SampleRange range{
        .first = first, .chunk = count / each, .chunks = 1, .samples_per_observation = each};
    std::vector<TileTotals> totals(shading.tiles.size());
    executor.for_each(shading.tiles.size(), [&](std::size_t t) {
        if (stop.is_up()) return;
        const Tile& tile = shading.tiles[t];
        const auto points = std::span(shading.points).subspan(tile.first, tile.count);
        TileJob<float> job = strategy.job(tile, points);
        job.stop = &stop;
        const auto run = [&](Workspace<float>& workspace) {
            totals[t] =
                workspace.run(job, strategy.pipeline(tile), range,
                              std::span(band.results).subspan(tile.first, tile.count), {}, {});
        };
        // Where it is stopped, the samples that were taken stay.
        static_cast<void>(ends_without<Stopped>([&] { workspaces.with(run); }));
    });
    TileTotals sum;
    for (const TileTotals& t : totals) sum.add(t);
    return sum;
}

std::uint64_t least_samples(const Band& band)
{
    std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
    for (const PointResult& result : band.results) least = std::min(least, result.luminance.count);
    return band.results.empty() ? 0
                                : least * static_cast<std::uint64_t>(band.samples_per_observation);
}

void draw_band(const LitScene& scene, const Band& band, Image& image)
{
    for (std::size_t p = 0; p < band.results.size(); ++p)
        image.pixels[band.shading.points[p].id] = vec_cast<float>(band.results[p].mean());
    for (const Background& pixel : band.shading.background)
        if (pixel.light >= 0)
            image.pixels[pixel.pixel] = vec_cast<float>(
                radiance(scene.scene().lights[static_cast<std::size_t>(pixel.light)]));
}

}  // namespace mis
