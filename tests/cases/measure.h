#pragma once

#include "mis/trace/analytic.h"

#include "tests/engine/bench.h"

#include <cmath>
#include <functional>
#include <optional>

namespace mis {

/// A scene of the suite, ready for any strategy; its surfaces are traced in closed form.
struct ReadyCase {
    std::optional<AnalyticTracer> tracer;
    TestScene test;

    explicit ReadyCase(const Scene& scene)
        : tracer(scene.surfaces.empty() ? std::nullopt : std::optional<AnalyticTracer>(scene)),
          test(scene, tracer ? &*tracer : nullptr)
    {
    }
    /// The probe is inside a light, or on it: the engine makes no sample there.
    bool has_no_tile() const { return test.probes.tiles.empty(); }
};

/// A change to a strategy's pipeline before it runs.
template <class T> using PipelineChange = std::function<void(Pipeline<T>&)>;

/// Samples [first, first + samples) of the one probe, by the engine's own pipeline.
template <class T>
Outcome run_case(const ReadyCase& ready_case, const Strategy& strategy, const Kernels<T>& kernels,
                 int samples, std::uint64_t seed, const PipelineChange<T>& change = {})
{
    Outcome outcome;
    if (ready_case.has_no_tile()) return outcome;
    const ReadyStrategy<T> ready(ready_case.test.lit, strategy, kernels, seed);
    const Tile& tile = ready_case.test.probes.tiles.at(0);
    Pipeline<T> pipeline = ready.pipeline(tile.material);
    if (change) change(pipeline);
    static thread_local Workspace<T> workspace;
    outcome.totals =
        workspace.run(ready.job(tile, ready_case.test.probes.points), pipeline,
                      {.chunk = samples, .chunks = 1}, std::span(&outcome.result, 1), {}, {});
    return outcome;
}

/// What rounding may make of one sample. Numbers are floats or doubles, but in both a direction of
/// the shading point is a float, which is off by ε = 2⁻²⁴. A lobe of width w makes ε/w of that, and
/// several operations add up (docs/theory-predict.md §2, the same bound).
inline double rounding_of(const Scene& scene)
{
    const Material& m = scene.materials[static_cast<std::size_t>(scene.probes[0].material)];
    const double width = m.type == "ggx" ? m.alpha : 1 / std::sqrt(1 + m.exponent);
    return 4 * 0x1p-24 * (20 + (m.type == "lambert" ? 0 : 1 / width));
}

}  // namespace mis
