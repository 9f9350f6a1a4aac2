#pragma once

#include "scene.h"

namespace host {

/// One sample of the direct light that a vertex reflects: of a light drawn from all alike.
inline Vec sample_one_light(const Scene& scene, const Vertex& at, Random& random)
{
    const auto count = static_cast<float>(scene.lights.size());
    if (scene.lights.empty()) return {};
    const Light& light = scene.lights[static_cast<std::size_t>(random.number() * count)];
    const LightDraw draw = draw_towards(light, at.x, random);
    const float cos_theta = dot(at.n(), draw.wi);
    if (!(draw.pdf > 0 && cos_theta > 0)) return {};
    Ray ray = at.ray(draw.wi, draw.distance);
    if (scene.surfaces.is_occluded(ray)) return {};
    if (const Light* nearer = scene.nearest_light(ray); nearer && nearer != &light) return {};
    return at.evaluate(draw.wi) * light.radiance * (cos_theta * count / draw.pdf);
}

}  // namespace host
