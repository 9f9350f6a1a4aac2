#include "mis/engine/lit_scene.h"

#include "mis/engine/choices.h"
#include "mis/strategy/names.h"

namespace mis {

LitScene::LitScene(const Scene& scene, const SurfaceTracer* surfaces, const Effects& effects)
    : scene_(&scene), surfaces_(surfaces), effects_(effects), hierarchy_(scene.lights),
      planner_(scene, hierarchy_, effects,
               surfaces != nullptr ? surfaces->origin() : Vec3<double>(0))
{
    for (const Material& material : scene.materials) bsdfs_.push_back(make_bsdf(material));
}

template <class T>
ReadyStrategy<T>::ReadyStrategy(const LitScene& scene, const Strategy& strategy,
                                const Kernels<T>& kernels, NumberSource numbers)
    : scene_(&scene), strategy_(strategy)
{
    const Lights& lights = scene.scene().lights;
    if (strategy.chooses_light() && numbers.is_sobol()) {
        order_ = std::make_shared<LightOrder>(spatial_order(lights));
        policy_ = make_policy(strategy.policy, in_order(lights, *order_));
    } else if (strategy.chooses_light()) {
        policy_ = make_policy(strategy.policy, lights);
    }
    for (const Material& material : scene.scene().materials) {
        pipelines_.emplace_back();
        for (const bool shadows : {false, true})
            for (const bool light_occlusion : {false, true}) {
                Effects effects = scene.effects();
                effects.shadows &= shadows, effects.light_occlusion &= light_occlusion;
                pipelines_.back()[shadows][light_occlusion] =
                    compose(kernels, strategy, material.type, effects, numbers);
            }
    }
    common_.lights = &lights;
    common_.order = order_.get();
    common_.hierarchy = &scene.lights();
    common_.surfaces = scene.surfaces();
    common_.policy = policy_.get();
    common_.numbers = numbers;
    const bool one_sample = strategy.model == Model::one_sample;
    common_.draws_every_light = strategy.chooses_light() && draws_every_light(strategy.policy);
    common_.draws_per_light = static_cast<std::uint32_t>(std::max(strategy.counts[0], 1));
    common_.bsdf_draws =
        strategy.chooses_light() ? static_cast<std::uint32_t>(std::max(strategy.counts[1], 1)) : 1;
    const std::array<double, 2> counts =
        one_sample ? std::array{0.5, 0.5}
                   : std::array<double, 2>{static_cast<double>(strategy.counts[0]),
                                           static_cast<double>(strategy.counts[1])};
    common_.light_count = static_cast<T>(counts[0]);
    common_.bsdf_count = static_cast<T>(counts[1]);
}

template <class T>
TileJob<T> ReadyStrategy<T>::job(const Tile& tile, std::span<const ShadingPoint> points) const
{
    TileJob<T> job = common_;
    job.points = points;
    job.origin = tile.origin;
    job.proofs = tile.plan.lights;
    job.blockers = tile.plan.blockers.get();
    const AnyBsdf bsdf = scene_->bsdf(tile.material);
    job.bsdf = bsdf.object, job.bsdf_type = bsdf.type;
    return job;
}

template class ReadyStrategy<float>;
template class ReadyStrategy<double>;

}  // namespace mis
