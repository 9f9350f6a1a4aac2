#include "mis/engine/lit_scene.h"

#include "mis/engine/choices.h"

namespace mis {

LitScene::LitScene(const Scene& scene, const SurfaceTracer* surfaces, const Effects& effects)
    : scene_(&scene), surfaces_(surfaces), effects_(effects), hierarchy_(scene.lights)
{
    for (const Material& material : scene.materials) bsdfs_.push_back(make_bsdf(material));
}

template <class T>
ReadyStrategy<T>::ReadyStrategy(const LitScene& scene, const Strategy& strategy,
                                const Kernels<T>& kernels, std::uint64_t seed)
    : scene_(&scene), strategy_(strategy)
{
    if (strategy.chooses_light()) policy_ = make_policy(strategy.policy, scene.scene().lights);
    for (const Material& material : scene.scene().materials)
        pipelines_.push_back(compose(kernels, strategy, material.type, scene.effects()));
    common_.lights = &scene.scene().lights;
    common_.hierarchy = &scene.lights();
    common_.surfaces = scene.surfaces();
    common_.policy = policy_.get();
    common_.seed = seed;
    const bool one_sample = strategy.model == Model::one_sample;
    common_.draws_per_light = static_cast<std::uint32_t>(std::max(strategy.counts[0], 1));
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
    const AnyBsdf bsdf = scene_->bsdf(tile.material);
    job.bsdf = bsdf.object, job.bsdf_type = bsdf.type;
    return job;
}

template class ReadyStrategy<float>;
template class ReadyStrategy<double>;

}  // namespace mis
