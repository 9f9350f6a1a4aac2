#pragma once

#include <mis/mis.h>
#include "../one_light.h"

namespace host {

inline mis::Vec3<float> to_mis(const Vec& a) { return {a.x, a.y, a.z}; }
inline Vec from_mis(const mis::Vec3<float>& a) { return {a.x, a.y, a.z}; }

/// The BSDF of a vertex, as mis asks for it.
struct VertexBsdf {
    const Vertex& at;
    auto evaluate(const auto& wi) const { return to_mis(at.evaluate(from_mis(wi))); }
    float pdf(const auto& wi) const { return at.pdf(from_mis(wi)); }
    auto sample(float lobe, const auto& u) const { return to_mis(at.sample(lobe, u.x, u.y)); }
};

/// Light along rays into a scene. One per thread.
class Integrator {
public:
    explicit Integrator(const Scene& scene) : scene_(scene)
    {
        mis::Lights lights;
        for (const Light& l : scene.lights)
            lights.push_back(
                mis::make_light(to_mis(l.center), double(l.radius), to_mis(l.radiance)));
        lights_.assign(lights);
    }

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
        const auto u = [&] { return random.number(); };
        const auto numbers = [&](int) -> mis::DirectNumbers<float> {
            return {random.bits64(), {u(), u()}, u(), {u(), u()}};
        };
        const auto is_occluded = [&](const mis::Vec3<float>& wi, float distance) {
            return scene_.surfaces.is_occluded(at.ray(from_mis(wi), distance));
        };
        point_.move_to(to_mis(at.x), to_mis(at.n()));
        return from_mis(mis::sample_direct<mis::PowerHeuristic, mis::ConeTechnique>(
                            point_, VertexBsdf{at}, is_occluded, numbers)
                            .radiance);
    }

private:
    const Scene& scene_;
    mis::DirectLights<mis::IrradiancePolicy> lights_{{}};
    mis::DirectPoint<mis::IrradiancePolicy> point_{lights_};
};

}  // namespace host
