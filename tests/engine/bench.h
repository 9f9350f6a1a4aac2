#pragma once

#include "mis/engine/lit_scene.h"
#include "mis/run/serial.h"
#include "mis/strategy/names.h"

#include "tests/support/quadrature.h"
#include "tests/support/scenes.h"

namespace mis {

/// Every strategy that has a meaning, with its usual counts, then some with other counts.
inline std::vector<Strategy> every_strategy()
{
    std::vector<Strategy> list;
    const auto add_if_legal = [&](const Strategy& s) {
        try {
            list.push_back(checked(s));
        } catch (const StrategyError&) {
        }
    };
    for (const Choosable& technique : technique_names())
        add_if_legal({"", "", technique.name, Model::multi, {0, 1}});
    for (const Choosable& policy : policy_names())
        for (const Choosable& heuristic : heuristic_names())
            for (const Choosable& technique : technique_names())
                for (const std::array<int, 2> counts : {std::array{1, 0}, {1, 1}, {3, 2}}) {
                    add_if_legal(
                        {policy.name, heuristic.name, technique.name, Model::multi, counts});
                    add_if_legal(
                        {policy.name, heuristic.name, technique.name, Model::one_sample, counts});
                }
    return list;
}

/// Those, and strategies whose samples come together.
inline std::vector<Strategy> every_strategy_and_strata()
{
    std::vector<Strategy> list = every_strategy();
    for (const int draws : {1, 4, 16, 64}) list.push_back(strata(draws));
    return list;
}

/// A scene with its probes found, ready for any strategy.
struct TestScene {
    Scene scene;
    LitScene lit;
    GBuffer probes;

    explicit TestScene(const Scene& s, const SurfaceTracer* surfaces = nullptr)
        : TestScene(s, surfaces, called_for(s))
    {
    }
    TestScene(const Scene& s, const SurfaceTracer* surfaces, const Effects& effects)
        : scene(s), lit(scene, surfaces, effects),
          probes(probe_points(scene, lit.lights(), surfaces, any_executor(SerialExecutor{})))
    {
    }
    /// The only probe as a point to be sampled all the same, where no light can reach it.
    void sample_the_dark()
    {
        if (!probes.tiles.empty()) return;
        const Probe& probe = scene.probes.at(0);
        probes.points = {{probe.position, vec_cast<float>(probe.normal),
                          vec_cast<float>(probe.outgoing), Vec3<float>(0), 0}};
        probes.tiles = {{0, 1, probe.material, probe.position}};
        probes.dark.clear();
    }
    TestScene(const TestScene&) = delete;
    TestScene& operator=(const TestScene&) = delete;
};

struct Outcome {
    PointResult result;
    TileTotals totals;
};

/// Samples [0, samples) of a scene's first probe, or as many more as come together.
template <class T>
Outcome run_probe(const TestScene& test, const Strategy& strategy, const Kernels<T>& kernels,
                  int samples, std::uint64_t seed = 1)
{
    const ReadyStrategy<T> ready(test.lit, strategy, kernels, seed);
    const Tile& tile = test.probes.tiles.at(0);
    Workspace<T> workspace;
    Outcome outcome;
    const int each = samples_together(strategy);
    const SampleRange range{.chunk = (samples + each - 1) / each, .samples_per_observation = each};
    outcome.totals =
        workspace.run(ready.job(tile, test.probes.points), ready.pipeline(tile.material), range,
                      std::span(&outcome.result, 1), {}, {});
    return outcome;
}

}  // namespace mis
