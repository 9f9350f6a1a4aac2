#include "mis/compare/savings.h"

#include "mis/strategy/strategy.h"

#include <algorithm>
#include <array>

namespace mis {

namespace {

constexpr int repetitions = 7, samples = 4;

/// The buffer with an effect simulated for every tile and light again.
GBuffer with_effect(GBuffer shading, bool TilePlan::*effect, LightProof proof)
{
    for (Tile& tile : shading.tiles) {
        tile.plan.*effect = true;
        if (proof == unhidden) tile.plan.blockers = nullptr;
        for (std::uint8_t& proofs : tile.plan.lights)
            proofs = static_cast<std::uint8_t>(proofs & ~proof);
    }
    return shading;
}

TileTotals run(const ReadyStrategy<float>& strategy, Workspace<float>& workspace,
               const GBuffer& shading)
{
    TileTotals totals;
    for (const Tile& tile : shading.tiles) {
        std::vector<PointResult> results(tile.count);
        totals.add(workspace.run(
            strategy.job(tile, std::span(shading.points).subspan(tile.first, tile.count)),
            strategy.pipeline(tile), {.chunk = samples, .chunks = 1}, results, {}, {}));
    }
    return totals;
}

void measure(const ReadyStrategy<float>& strategy, const GBuffer& planned, const GBuffer& full,
             EffectPlan& effect)
{
    Workspace<float> workspace;
    std::array<double, repetitions> saved{};
    for (double& seconds : saved) {
        const TileTotals with = run(strategy, workspace, full),
                         without = run(strategy, workspace, planned);
        const double count = static_cast<double>(with.samples);
        seconds = (with.seconds - without.seconds) / count;
        effect.saved_rays_per_sample =
            (static_cast<double>(with.shadow_rays) - static_cast<double>(without.shadow_rays)) /
            count;
    }
    std::sort(saved.begin(), saved.end());
    effect.saved_seconds_per_sample = saved[repetitions / 2];
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
                     std::vector<EffectPlan>& effects)
{
    if (!scene.effects().by_tile || shading.tiles.empty()) return;
    const ReadyStrategy<float> strategy(scene, parse_strategy("uniform/power"), kernels<float>(),
                                        1);
    for (EffectPlan& effect : effects) {
        if (effect.name == "shadows" && scene.effects().shadows)
            measure(strategy, shading, with_effect(shading, &TilePlan::shadows, unshadowed),
                    effect);
        if (effect.name == "light_occlusion" && scene.effects().light_occlusion)
            measure(strategy, shading, with_effect(shading, &TilePlan::light_occlusion, unhidden),
                    effect);
    }
}

}  // namespace mis
