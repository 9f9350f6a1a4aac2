#include "bench/recording.h"

namespace mis::bench {

Recording::Recording(const Ready& ready, const std::string& strategy)
{
    const RecordingTracer tracer(*ready.tracer);
    const LitScene lit(ready.scene, &tracer, ready.lit.effects());
    const ReadyStrategy<float> prepared(lit, parse_strategy(strategy), kernels<float>(), 1);
    Workspace<float> workspace;
    for (const Tile& tile : ready.shading.tiles) {
        std::vector<PointResult> results(tile.count);
        const TileTotals totals =
            workspace.run(prepared.job(tile, ready.points_of(tile)), prepared.pipeline(tile),
                          {.first = 0, .chunk = samples_per_point, .chunks = 1}, results, {}, {});
        samples += totals.samples;
    }
    rays = tracer.rays();
    hidden = tracer.hidden();
}

}  // namespace mis::bench
