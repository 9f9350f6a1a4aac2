#include "mis/engine/lit_scene.h"

#include "mis/engine/choices.h"
#include "mis/engine/radiance_scale.h"
#include "mis/strategy/names.h"
#include "mis/trace/surface_points.h"

#include <algorithm>

namespace mis {

LitScene::LitScene(const Scene& scene, const SurfaceTracer* surfaces, const Effects& effects)
    : scene_(&scene), surfaces_(surfaces), effects_(effects), hierarchy_(scene.lights),
      planner_(scene, hierarchy_, effects,
               surfaces != nullptr ? surfaces->origin() : Vec3<double>(0)),
      has_grey_lights_(are_grey(scene.lights)),
      radiance_scale_(mis::radiance_scale(scene.lights, frame_origin_of(scene)))
{
    for (const Material& material : scene.materials) bsdfs_.push_back(make_bsdf(material));
}

Effects LitScene::effects(int material) const
{
    Effects effects = effects_;
    if (!effects.by_tile) return effects;
    effects.specular = effects.specular && !is_diffuse(bsdf(material));
    effects.colour =
        effects.colour &&
        !(has_grey_lights_ && is_grey(scene_->materials[static_cast<std::size_t>(material)]));
    return effects;
}

EffectShares LitScene::tiles_that_call(const GBuffer& buffer) const
{
    EffectShares counts;
    const auto one = [](bool is_on) { return is_on ? 1.0 : 0.0; };
    for (const Tile& tile : buffer.tiles) {
        const Effects on = effects(tile.material);
        counts.add({one(tile.plan.shadows && on.shadows),
                    one(tile.plan.light_occlusion && on.light_occlusion),
                    one(tile.plan.horizon && on.horizon), one(on.specular), one(on.choice),
                    one(on.colour)});
    }
    return counts;
}

template <class T>
ReadyStrategy<T>::ReadyStrategy(const LitScene& scene, const Strategy& strategy,
                                const Kernels<T>& kernels, NumberSource numbers,
                                const Effects& also)
    : scene_(&scene), strategy_(strategy)
{
    const Lights& lights = scene.scene().lights;
    if (strategy.chooses_light() && numbers.is_sobol()) {
        order_ = std::make_shared<LightOrder>(spatial_order(lights));
        policy_ = make_policy(strategy.policy, in_order(lights, *order_));
    } else if (strategy.chooses_light()) {
        policy_ = make_policy(strategy.policy, lights);
    }
    const std::vector<Material>& materials = scene.scene().materials;
    pipelines_.resize(materials.size());
    for (std::size_t m = 0; m < materials.size(); ++m) {
        Effects whole = scene.effects(static_cast<int>(m));
        whole.specular |= also.specular, whole.choice |= also.choice, whole.colour |= also.colour;
        for (const int k : {0, 1, 2, 3, 4, 5, 6, 7}) {
            const bool shadows = (k & 4) != 0, light_occlusion = (k & 2) != 0,
                       horizon = (k & 1) != 0;
            Effects effects = whole;
            effects.shadows &= shadows, effects.light_occlusion &= light_occlusion;
            effects.horizon &= horizon;
            pipelines_[m][shadows][light_occlusion][horizon] =
                compose(kernels, strategy, materials[m].type, effects, numbers);
        }
    }
    common_.radiance_scale = scene.radiance_scale();
    common_.radiance_unit = 1 / scene.radiance_scale();
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
