// What one sample costs: without rays per instruction set and BSDF, and as a whole on scenes that
// are shipped.
#include "mis/engine/lit_scene.h"
#include "mis/io/scene_json.h"
#include "mis/run/serial.h"
#include "mis/trace/embree.h"

#include <benchmark/benchmark.h>

#include <filesystem>
#include <memory>

namespace {

using namespace mis;  // NOLINT: a program of its own

/// A scene made ready, and the shading points of its picture.
struct Ready {
    explicit Ready(const std::string& name, bool with_rays)
        : scene(read_scene(std::filesystem::path(MIS_SOURCE_DIR) / "scenes" / (name + ".json"))),
          tracer(std::make_unique<EmbreeTracer>(scene)),
          lit(scene, tracer.get(), effects_of(scene, with_rays))
    {
        const AnyExecutor serial = any_executor(SerialExecutor{});
        shading = find_shading_points(scene, lit.lights(), tracer.get(), 0,
                                      scene.camera->resolution[1], serial);
    }
    static Effects effects_of(const Scene& scene, bool with_rays)
    {
        Effects effects = called_for(scene);
        if (!with_rays) effects.shadows = effects.light_occlusion = false;
        return effects;
    }
    Scene scene;
    std::unique_ptr<SurfaceTracer> tracer;
    LitScene lit;
    GBuffer shading;
};

/// 16 samples of every point of some tiles, over and over; material: of the tiles, or −1 for all.
template <class T>
void run(benchmark::State& state, const Ready& ready, const std::string& strategy,
         const Kernels<T>& kernels, int material)
{
    const ReadyStrategy<T> prepared(ready.lit, parse_strategy(strategy), kernels, 1);
    Workspace<T> workspace;
    TileTotals totals;
    std::size_t t = 0;
    for (auto _ : state) {
        const Tile& tile = ready.shading.tiles[t++ % ready.shading.tiles.size()];
        if (material >= 0 && tile.material != material) continue;
        std::vector<PointResult> results(tile.count);
        totals.add(workspace.run(
            prepared.job(tile, std::span(ready.shading.points).subspan(tile.first, tile.count)),
            prepared.pipeline(tile.material), {.first = 0, .chunk = 16, .chunks = 1}, results, {},
            {}));
    }
    const double samples = static_cast<double>(std::max<std::uint64_t>(totals.samples, 1));
    state.counters["ns_per_sample"] = 1e9 * totals.seconds / samples;
    state.counters["rays_per_sample"] = static_cast<double>(totals.shadow_rays) / samples;
    for (std::size_t k = 0; k < stage_names.size(); ++k)
        state.counters["ns_" + std::string(stage_names[k])] =
            1e9 * totals.stage_seconds[k] / samples;
}

void add_without_rays()
{
    const auto ready = std::make_shared<Ready>("veach-blinn", false);
    const auto ggx = std::make_shared<Ready>("veach", false);
    for (const std::string_view isa : instruction_sets())
        for (const auto& pair :
             {std::pair{std::string("lambert"), ready}, {"blinn", ready}, {"ggx", ggx}}) {
            const std::string bsdf = pair.first;
            const std::shared_ptr<Ready> scene = pair.second;
            int material = -1;
            for (std::size_t m = 0; m < scene->scene.materials.size(); ++m)
                if (scene->scene.materials[m].type == bsdf) material = static_cast<int>(m);
            const std::string name = "without_rays/" + bsdf + "/" + std::string(isa);
            benchmark::RegisterBenchmark((name + "/float").c_str(), [=](benchmark::State& state) {
                run(state, *scene, "solid-angle/power", kernels_of<float>(isa), material);
            });
            benchmark::RegisterBenchmark((name + "/double").c_str(), [=](benchmark::State& state) {
                run(state, *scene, "solid-angle/power", kernels_of<double>(isa), material);
            });
        }
}

void add_scenes()
{
    for (const char* name : {"single", "veach", "hundred", "street"}) {
        const auto ready = std::make_shared<Ready>(name, true);
        for (const char* strategy : {"uniform/power", "power/power", "radiant-solid-angle/power",
                                     "radiant-solid-angle/light", "brdf"})
            benchmark::RegisterBenchmark((std::string("scene/") + name + "/" + strategy).c_str(),
                                         [=](benchmark::State& state) {
                                             run(state, *ready, strategy, kernels<float>(), -1);
                                         });
    }
}

}  // namespace

int main(int argc, char** argv)
{
    add_without_rays();
    add_scenes();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
