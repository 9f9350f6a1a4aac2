#pragma once

#include "../one_light.h"

namespace host {

/// Light along rays into a scene. One per thread.
class Integrator {
public:
    explicit Integrator(const Scene& scene) : scene_(scene) {}

    /// One sample of the radiance along a ray: direct light where it meets a surface, and over
    /// `bounces` reflections.
    Vec radiance(Ray ray, int bounces, Random& random)
    {
        Vec sum, share{1, 1, 1};
        for (int bounce = 0;; ++bounce) {
            const int primitive = scene_.surfaces.nearest(ray);
            if (const Light* light = scene_.nearest_light(ray))
                return bounce == 0 ? light->radiance : sum;  // later, direct light has it
            if (primitive < 0) return sum;
            const Vertex at = scene_.vertex(ray, primitive);
            sum += share * direct_light(at, random);
            if (bounce == bounces) return sum;
            const float lobe = random.number(), u = random.number(), v = random.number();
            const Vec wi = at.sample(lobe, u, v);
            const float cos_theta = dot(at.n(), wi), pdf = at.pdf(wi);
            if (!(cos_theta > 0 && pdf > 0)) return sum;
            share = share * at.evaluate(wi) * (cos_theta / pdf);
            ray = at.ray(wi);
        }
    }

    /// One sample of the direct light that a vertex reflects.
    Vec direct_light(const Vertex& at, Random& random)
    {
        return sample_one_light(scene_, at, random);
    }

private:
    const Scene& scene_;
};

}  // namespace host
