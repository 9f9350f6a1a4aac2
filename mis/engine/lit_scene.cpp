#include "mis/engine/lit_scene.h"

#include "mis/engine/choices.h"
#include "mis/engine/radiance_scale.h"
#include "mis/math/raise.h"
#include "mis/strategy/names.h"
#include "mis/trace/surface_points.h"

#include <algorithm>

namespace mis {

LitScene::LitScene(const Scene& scene, const SurfaceTracer* surfaces, const Effects& effects,
                   const StopToken& stop)
    : scene_(&scene), surfaces_(surfaces), effects_(effects), hierarchy_(scene.lights, stop),
      planner_(scene, hierarchy_, effects,
               surfaces != nullptr ? surfaces->origin() : Vec3<double>(0)),
      has_grey_lights_(are_grey(scene.lights)),
      radiance_scale_(mis::radiance_scale(scene.lights, frame_origin_of(scene)))
{
    for (const Material& material : scene.materials) {
        bsdfs_.push_back(make_bsdf(material));
        lobes_.push_back(make_lobe(material));
    }
}

Effects LitScene::effects(int material) const
{
    Effects effects = effects_;
    if (!effects.by_tile) return effects;
    if (is_diffuse(bsdf(material))) effects.on.set(Effect::specular, false);
    if (has_grey_lights_ && is_grey(scene_->materials[static_cast<std::size_t>(material)]))
        effects.on.set(Effect::colour, false);
    return effects;
}

namespace {

/// Of what is simulated on a material, what a tile leaves of it.
EffectSet of_tile(EffectSet of_material, EffectSet of_tile_itself)
{
    return of_material - (effects_of_tiles - of_tile_itself);
}

}  // namespace

EffectShares LitScene::tiles_that_call(const GBuffer& buffer) const
{
    EffectShares counts;
    for (const Tile& tile : buffer.tiles)
        counts.add(of_tile(effects(tile.material).on, tile.plan.effects));
    return counts;
}

std::shared_ptr<const void> LitScene::policy(const std::string& name, const StopToken& stop) const
{
    return policies_->get(name, [&] { return make_policy(name, scene_->lights, stop); });
}

std::shared_ptr<const LightOrder> LitScene::order(const StopToken& stop) const
{
    return std::static_pointer_cast<const LightOrder>(orders_->get("space", [&] {
        return std::make_shared<const LightOrder>(spatial_order(scene_->lights, stop));
    }));
}

std::shared_ptr<const void> LitScene::policy_in_order(const std::string& name,
                                                      const StopToken& stop) const
{
    const std::shared_ptr<const LightOrder> by_place = order(stop);
    return policies_in_order_->get(
        name, [&] { return make_policy(name, in_order(scene_->lights, *by_place), stop); });
}

template <class T>
ReadyStrategy<T>::ReadyStrategy(const LitScene& scene, const Strategy& strategy,
                                const Kernels<T>& kernels, NumberSource numbers, EffectSet also,
                                const StopToken& stop)
    : scene_(&scene), strategy_(strategy)
{
    const Lights& lights = scene.scene().lights;
    if (strategy.model == Model::strata) {
        if (lights.size() > most_strata_lights)
            raise<StrategyError>(too_many_lights(strategy, lights.size()));
        if (!numbers.is_asked_for) numbers.samples_per_scrambling = one_scrambling;
        order_ = scene.order(stop);
    } else if (strategy.chooses_light() && numbers.is_sobol()) {
        order_ = scene.order(stop);
        policy_ = scene.policy_in_order(strategy.policy, stop);
    } else if (strategy.chooses_light()) {
        policy_ = scene.policy(strategy.policy, stop);
    }
    const std::vector<Material>& materials = scene.scene().materials;
    pipelines_.resize(materials.size());
    for (std::size_t m = 0; m < materials.size(); ++m) {
        Effects whole = scene.effects(static_cast<int>(m));
        whole.on = whole.on | (also - effects_of_tiles);
        Strategy of_material = strategy;
        if (strategy.model == Model::strata && scene.lobe(static_cast<int>(m)) == nullptr)
            of_material.counts[1] = 0;  // there, light draws alone have no noise but visibility
        for (std::size_t bits = 0; bits < pipelines_[m].size(); ++bits) {
            Effects effects = whole;
            effects.on = of_tile(whole.on, EffectSet::of_bits(bits));
            pipelines_[m][bits] =
                compose(kernels, of_material, materials[m].type, effects, numbers);
        }
    }
    common_.radiance_scale = scene.radiance_scale();
    common_.radiance_unit = 1 / scene.radiance_scale();
    common_.lights = &lights;
    const std::optional<Camera>& camera = scene.scene().camera;
    common_.picture_width = camera ? static_cast<std::uint32_t>(camera->resolution[0]) : 0;
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
    job.lobe = scene_->lobe(tile.material);
    return job;
}

template class ReadyStrategy<float>;
template class ReadyStrategy<double>;

}  // namespace mis
