#pragma once

#include "bvh.h"
#include "random.h"

namespace host {

/// A sphere that shines outwards. Lights are none of the surfaces: a ray asks for both.
struct Light {
    Vec center;
    float radius;
    Vec radiance;

    float hit(const Ray& ray) const { return Primitive{center, {}, {}, radius, 0}.hit(ray); }
};

/// A direction towards a light.
struct LightDraw {
    Vec wi;
    float distance;  ///< infinity where rounding misses the light
    float pdf;       ///< 1/sr; 0 where there is none
};

/// Uniform over the cone that a light fills, seen from x.
inline LightDraw draw_towards(const Light& light, const Vec& x, Random& random)
{
    const Vec to_center = light.center - x;
    const float sin2_max = light.radius * light.radius / dot(to_center, to_center);
    if (!(sin2_max < 1)) return {{}, 0, 0};
    const float one_minus_cos_max = sin2_max / (1 + std::sqrt(1 - sin2_max));
    const float one_minus_cos = random.number() * one_minus_cos_max, phi = 2 * pi * random.number();
    const float sin_theta = std::sqrt(one_minus_cos * (2 - one_minus_cos));
    const Vec wi =
        Frame(unit(to_center))
            .to_world({sin_theta * std::cos(phi), sin_theta * std::sin(phi), 1 - one_minus_cos});
    return {wi, light.hit({x, wi}), 1 / (2 * pi * one_minus_cos_max)};
}

}  // namespace host
