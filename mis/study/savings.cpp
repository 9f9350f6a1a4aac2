#include "mis/study/savings.h"

#include "mis/strategy/strategy.h"

#include <algorithm>
#include <array>

namespace mis {

namespace {

constexpr int repetitions = 7, samples_of_run = 4;

/// What proves of a tile's single lights that they do not call for an effect.
LightProof proof_of(Effect effect)
{
    switch (effect) {
        case Effect::shadows: return unshadowed;
        case Effect::light_occlusion: return unhidden;
        default: return {};
    }
}

/// The buffer with an effect of its tiles simulated for every tile and light again.
GBuffer with_effect(GBuffer shading, Effect effect)
{
    for (Tile& tile : shading.tiles) {
        tile.plan.effects.set(effect, true);
        if (effect == Effect::light_occlusion) tile.plan.blockers = nullptr;
        for (std::uint8_t& proofs : tile.plan.lights)
            proofs = static_cast<std::uint8_t>(proofs & ~proof_of(effect));
    }
    return shading;
}

TileTotals run(const ReadyStrategy<float>& strategy, Workspace<float>& workspace,
               const GBuffer& shading, const StopToken& stop)
{
    TileTotals totals;
    for (const Tile& tile : shading.tiles) {
        std::vector<PointResult> results(tile.count);
        TileJob<float> job =
            strategy.job(tile, std::span(shading.points).subspan(tile.first, tile.count));
        job.stop = &stop;
        totals.add(workspace.run(job, strategy.pipeline(tile),
                                 {.chunk = samples_of_run, .chunks = 1}, results, {}, {}));
    }
    return totals;
}

/// A strategy, and the tiles that it runs over.
struct Way {
    const ReadyStrategy<float>& strategy;
    const GBuffer& shading;
};

void measure(const Way& lean, const Way& full, const StopToken& stop, EffectPlan& effect)
{
    Workspace<float> workspace;
    std::array<double, repetitions> saved{};
    double saved_rays = 0;
    for (double& seconds : saved) {
        const TileTotals with = run(full.strategy, workspace, full.shading, stop),
                         without = run(lean.strategy, workspace, lean.shading, stop);
        const double count = static_cast<double>(with.samples);
        seconds = (with.seconds - without.seconds) / count;
        saved_rays =
            (static_cast<double>(with.shadow_rays) - static_cast<double>(without.shadow_rays)) /
            count;
    }
    effect.saved_rays_per_sample = saved_rays;
    std::sort(saved.begin(), saved.end());
    // Time that noise hides is not shown: six of seven pairs must save some (chance: once in 16).
    const bool is_resolved = saved[1] > 0;
    if (is_resolved) effect.saved_seconds_per_sample = saved[repetitions / 2];
}

}  // namespace

GBuffer spread_tiles(const GBuffer& shading, std::size_t most)
{
    GBuffer some;
    const std::size_t count = std::min(most, shading.tiles.size());
    for (std::size_t i = 0; i < count; ++i) {
        Tile tile = shading.tiles[i * shading.tiles.size() / count];
        const auto points = std::span(shading.points).subspan(tile.first, tile.count);
        tile.first = static_cast<std::uint32_t>(some.points.size());
        some.points.insert(some.points.end(), points.begin(), points.end());
        some.tiles.push_back(tile);
    }
    return some;
}

void measure_savings(const LitScene& scene, const GBuffer& shading,
                     std::vector<EffectPlan>& effects, const StopToken& stop)
{
    if (!scene.effects().by_tile || shading.tiles.empty()) return;
    const auto ready = [&](EffectSet also) {
        return ReadyStrategy<float>(scene, parse_strategy("uniform/power"), kernels<float>(), 1,
                                    also, stop);
    };
    const ReadyStrategy<float> strategy = ready({});
    for (EffectPlan& plan : effects) {
        const Effect effect = find_effect(plan.name).value();
        if (!effects_of_tiles.has(effect)) {
            if (plan.share < 1)
                measure({strategy, shading}, {ready({effect}), shading}, stop, plan);
        } else if (scene.effects().on.has(effect)) {
            measure({strategy, shading}, {strategy, with_effect(shading, effect)}, stop, plan);
        }
    }
}

}  // namespace mis
