#include "bench/ready.h"

#include "mis/io/scene_json.h"
#include "mis/run/serial.h"
#include "mis/trace/embree.h"

#include <filesystem>

namespace mis::bench {

namespace {
Effects effects_of(const Scene& scene, Effect effect)
{
    if (effect == Effect::called_for) return called_for(scene);
    Effects effects = all_effects(scene);
    if (effect == Effect::none)
        effects.on = effects.on - EffectSet{mis::Effect::shadows, mis::Effect::light_occlusion};
    return effects;
}
}  // namespace

Ready::Ready(Scene made, Effect effect)
    : scene(std::move(made)), tracer(std::make_unique<EmbreeTracer>(scene)),
      lit(scene, tracer.get(), effects_of(scene, effect)),
      shading(find_shading_points(scene, lit.lights(), tracer.get(), 0, scene.camera->resolution[1],
                                  any_executor(SerialExecutor{})))
{
    lit.expect_samples(samples_of_long_run);
    lit.plan(shading, any_executor(SerialExecutor{}));
}

std::vector<const Tile*> Ready::tiles_of(int material) const
{
    std::vector<const Tile*> tiles;
    for (const Tile& tile : shading.tiles)
        if (material < 0 || tile.material == material) tiles.push_back(&tile);
    return tiles;
}

std::string source_path(const std::string& relative)
{
    return (std::filesystem::path(MIS_SOURCE_DIR) / relative).string();
}

Scene shipped_scene(const std::string& name)
{
    return read_scene(source_path("scenes/" + name + ".json"));
}

LazyReady ready_lazily(std::function<Scene()> scene, Effect effect)
{
    return lazily<Ready>([=] { return new Ready(scene(), effect); });
}

template <class T>
void run_tiles(benchmark::State& state, const Ready& ready, const std::string& strategy,
               const Kernels<T>& kernels, const Part& part)
{
    const ReadyStrategy<T> prepared(ready.lit, parse_strategy(strategy), kernels, 1);
    const std::vector<const Tile*> tiles = ready.tiles_of(part.material);
    Workspace<T> workspace;
    TileTotals totals;
    std::size_t t = 0;
    for (auto _ : state) {
        const Tile& tile = *tiles[t++ % tiles.size()];
        const auto all = ready.points_of(tile);
        const auto points = all.first(std::min(part.points, all.size()));
        std::vector<PointResult> results(points.size());
        totals.add(workspace.run(prepared.job(tile, points), prepared.pipeline(tile),
                                 {.first = 0, .chunk = samples_per_point, .chunks = 1}, results, {},
                                 {}));
    }
    const auto samples = static_cast<double>(std::max<std::uint64_t>(totals.samples, 1));
    state.counters["ns_per_sample"] = 1e9 * totals.seconds / samples;
    state.counters["rays_per_sample"] = static_cast<double>(totals.shadow_rays) / samples;
    for (std::size_t k = 0; k < stage_names.size(); ++k)
        state.counters["ns_" + std::string(stage_names[k])] =
            1e9 * totals.stage_seconds[k] / samples;
}

template void run_tiles(benchmark::State&, const Ready&, const std::string&, const Kernels<float>&,
                        const Part&);
template void run_tiles(benchmark::State&, const Ready&, const std::string&, const Kernels<double>&,
                        const Part&);

}  // namespace mis::bench
