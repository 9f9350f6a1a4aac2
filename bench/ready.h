#pragma once

#include "mis/engine/lit_scene.h"

#include <benchmark/benchmark.h>

#include <functional>
#include <memory>
#include <string>

namespace mis::bench {

/// What is simulated: what each tile calls for, everything, or no occlusion at all.
enum class Effect { called_for, everything, none };

/// A scene made ready, and the shading points of its picture.
struct Ready {
    Ready(Scene made, Effect effect);

    std::vector<const Tile*> tiles_of(int material) const;  ///< −1: all
    std::span<const ShadingPoint> points_of(const Tile& tile) const
    {
        return std::span(shading.points).subspan(tile.first, tile.count);
    }

    Scene scene;
    std::unique_ptr<SurfaceTracer> tracer;
    LitScene lit;
    GBuffer shading;
};

Scene shipped_scene(const std::string& name);
std::string source_path(const std::string& relative);

/// Made when it is first asked for: a benchmark that is filtered out costs nothing.
template <class Value> std::function<const Value&()> lazily(std::function<Value*()> make)
{
    auto kept = std::make_shared<std::unique_ptr<Value>>();
    return [kept, make]() -> const Value& {
        if (*kept == nullptr) kept->reset(make());
        return **kept;
    };
}
using LazyReady = std::function<const Ready&()>;
LazyReady ready_lazily(std::function<Scene()> scene, Effect effect = Effect::called_for);

/// Samples per shading point: what is prepared once is shared by so many.
inline constexpr int samples_per_point = 16;

/// What is run over and over is a part of a long run, as scenes are told.
inline constexpr double samples_of_long_run = 1e4;

/// What of a scene is run.
struct Part {
    int material = -1;                           ///< of the tiles; −1: all
    std::size_t points = tile_side * tile_side;  ///< of each tile, at most
};

/// Lights tiles with a strategy, 16 samples of every point, one tile after the other, over and
/// over. Counters: ns_per_sample, rays_per_sample, and ns_STAGE, all of CPU time.
template <class T>
void run_tiles(benchmark::State& state, const Ready& ready, const std::string& strategy,
               const Kernels<T>& kernels, const Part& part = {});

extern template void run_tiles(benchmark::State&, const Ready&, const std::string&,
                               const Kernels<float>&, const Part&);
extern template void run_tiles(benchmark::State&, const Ready&, const std::string&,
                               const Kernels<double>&, const Part&);

}  // namespace mis::bench
