#pragma once

#include "mis/bsdf/registry.h"
#include "mis/math/frame.h"
#include "mis/predict/predict.h"

#include "tests/support/irradiance.h"

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

namespace mis::naive {

// The estimator as design §1 words it, written without care: textbook formulas, one sample at a
// time, double. It shares nothing with mis/predict but the BSDFs.

using Vec = Vec3<double>;
inline constexpr double no_hit = std::numeric_limits<double>::infinity();

struct Hit {
    int light = -1;
    double t = no_hit;
};

/// One probe's estimator of one strategy.
class Estimator {
public:
    Estimator(const Scene& scene, const Probe& probe, const Strategy& strategy)
        : scene_(scene), probe_(probe), s_(strategy), frame_(frame_around(probe.normal)),
          wo_(frame_.to_local(probe.outgoing))
    {
        const std::size_t count = scene.lights.size();
        double sum = 0;
        for (const Light& light : scene.lights) {
            const double d = glm::length(light.center - probe.position);
            const double solid =
                2 * std::numbers::pi * (1 - std::sqrt(1 - light.radius * light.radius / (d * d)));
            const double y = luminance(radiance(light));
            solid_angle_.push_back(solid);
            double weight = 1;
            if (s_.policy == "power") weight = y * light.radius * light.radius;
            if (s_.policy == "solid-angle") weight = solid;
            if (s_.policy == "radiant-solid-angle") weight = y * solid;
            const double s = light.radius / d;
            const double c = dot(probe.normal, light.center - probe.position) / d;
            irradiance_.push_back(s * s * exact_irradiance_over_sin2(s, c));
            if (s_.policy == "irradiance") weight = y * irradiance_.back();
            probability_.push_back(weight);
            sum += weight;
        }
        for (std::size_t j = 0; j < count; ++j)
            probability_[j] = s_.policy == "all" ? 1 : probability_[j] / sum;
        for_each_type(Bsdfs{}, [&]<class B>() {
            const Material& material = scene.materials[static_cast<std::size_t>(probe.material)];
            if (B::name != material.type) return;
            const B bsdf(material);
            f_ = [bsdf](const Vec& o, const Vec& i) { return bsdf.evaluate(o, i); };
            draw_ = [bsdf](const Vec& o, double lobe, Vec2<double> u) {
                return bsdf.sample(o, lobe, u);
            };
        });
    }

    /// Luminance of one sample.
    double sample()
    {
        if (!s_.chooses_light()) return alone();
        if (s_.model == Model::one_sample)
            return uniform() < 0.5 ? light_draw(choose()) : bsdf_draw();
        double sum = 0;
        if (s_.policy == "all") {
            for (int j = 0; j < int(scene_.lights.size()); ++j)
                for (int i = 0; i < s_.counts[0]; ++i) sum += light_draw(j);
        } else {
            for (int i = 0; i < s_.counts[0]; ++i) sum += light_draw(choose());
        }
        for (int i = 0; i < s_.counts[1]; ++i) sum += bsdf_draw();
        return sum;
    }

private:
    /// One number after the other: the order of arguments is the compiler's choice.
    Vec draw_from_bsdf()
    {
        const double v = uniform(), u = uniform();
        return draw_(wo_, uniform(), {u, v});
    }
    double uniform() { return std::generate_canonical<double, 53>(random_); }
    std::size_t index(int j) const { return static_cast<std::size_t>(j); }

    static double sphere(const Vec& c, double r, const Vec& w)
    {
        const double b = dot(c, w), disc = b * b - dot(c, c) + r * r;
        if (disc < 0) return no_hit;
        const double near = b - std::sqrt(disc), far = b + std::sqrt(disc);
        return near > 0 ? near : far > 0 ? far : no_hit;
    }
    Hit nearest(const Vec& w) const
    {
        Hit hit;
        for (int j = 0; j < int(scene_.lights.size()); ++j) {
            const Light& light = scene_.lights[index(j)];
            const double t = sphere(light.center - probe_.position, light.radius, w);
            if (t < hit.t) hit = {j, t};
        }
        for (const Surface& surface : scene_.surfaces)
            if (const auto* ball = std::get_if<SphereSurface>(&surface.shape)) {
                const double t = sphere(ball->center - probe_.position, ball->radius, w);
                if (t < hit.t) hit = {-1, t};
            }
        return hit;
    }
    bool holds(int j, const Vec& w) const
    {
        const Light& light = scene_.lights[index(j)];
        return sphere(light.center - probe_.position, light.radius, w) < no_hit;
    }
    double light_density(const Vec& w, int nearest_light) const
    {
        if (s_.technique == "projected")
            return probability_[index(nearest_light)] * dot(probe_.normal, w) /
                   irradiance_[index(nearest_light)];
        if (s_.technique != "union")
            return probability_[index(nearest_light)] / solid_angle_[index(nearest_light)];
        double sum = 0;
        for (int j = 0; j < int(scene_.lights.size()); ++j)
            if (holds(j, w)) sum += probability_[index(j)] / solid_angle_[index(j)];
        return sum;
    }
    int choose()
    {
        double u = uniform();
        int j = 0;
        while (j + 1 < int(probability_.size()) && u >= probability_[index(j)])
            u -= probability_[index(j++)];
        return j;
    }
    double light_draw(int j)
    {
        if (s_.technique == "projected" && irradiance_[index(j)] == 0) return 0;
        Vec w = in_cap(j);
        // In proportion to the cosine: by rejection, for all the cosines are below 1.
        while (s_.technique == "projected" && uniform() >= dot(probe_.normal, w)) w = in_cap(j);
        const Hit hit = nearest(w);
        if (hit.light < 0 || (s_.technique != "union" && hit.light != j)) return 0;
        return weighed(w, hit.light, true);
    }
    Vec in_cap(int j)
    {
        const Light& light = scene_.lights[index(j)];
        const Vec axis = glm::normalize(light.center - probe_.position);
        const double z = 1 - uniform() * solid_angle_[index(j)] / (2 * std::numbers::pi),
                     phi = 2 * std::numbers::pi * uniform();
        const double rho = std::sqrt(std::max(0.0, 1 - z * z));
        return frame_around(axis).to_world(Vec(rho * std::cos(phi), rho * std::sin(phi), z));
    }
    double bsdf_draw()
    {
        const Vec local = draw_from_bsdf();
        if (!(local.z > 0)) return 0;
        const Vec w = frame_.to_world(local);
        const Hit hit = nearest(w);
        return hit.light < 0 ? 0 : weighed(w, hit.light, false);
    }
    double integrand(const Vec& local, const Vec& f, int light) const
    {
        return luminance(f * radiance(scene_.lights[index(light)])) * local.z;
    }
    double weighed(const Vec& w, int light, bool by_light) const
    {
        const Vec local = frame_.to_local(w);
        if (!(local.z > 0)) return 0;
        const BsdfValue<double> value = f_(wo_, local);
        const bool one = s_.model == Model::one_sample;
        const double l = (one ? 0.5 : s_.counts[0]) * light_density(w, light),
                     b = (one ? 0.5 : s_.counts[1]) * value.pdf;
        double weight = 0;
        if (s_.heuristic == "light") weight = 1;
        if (s_.heuristic == "balance") weight = l / (l + b);
        if (s_.heuristic == "power") weight = l * l / (l * l + b * b);
        if (s_.heuristic == "maximum") weight = l >= b ? 1 : 0;
        if (s_.heuristic == "cutoff") {
            const double most = std::max(l, b), kept_l = l < 0.1 * most ? 0 : l,
                         kept_b = b < 0.1 * most ? 0 : b;
            weight = kept_l / (kept_l + kept_b);
        }
        return by_light ? weight * integrand(local, value.f, light) / l
                        : (1 - weight) * integrand(local, value.f, light) / b;
    }
    double alone()
    {
        Vec local;
        if (s_.technique == "brdf") local = draw_from_bsdf();
        const double phi = 2 * std::numbers::pi * uniform(), u = uniform();
        if (s_.technique == "cosine")
            local =
                Vec(std::sqrt(u) * std::cos(phi), std::sqrt(u) * std::sin(phi), std::sqrt(1 - u));
        if (s_.technique == "hemisphere")
            local =
                Vec(std::sqrt(1 - u * u) * std::cos(phi), std::sqrt(1 - u * u) * std::sin(phi), u);
        if (!(local.z > 0)) return 0;
        const Vec w = frame_.to_world(local);
        const Hit hit = nearest(w);
        if (hit.light < 0) return 0;
        const BsdfValue<double> value = f_(wo_, local);
        double pdf = value.pdf;
        if (s_.technique == "cosine") pdf = local.z / std::numbers::pi;
        if (s_.technique == "hemisphere") pdf = 0.5 / std::numbers::pi;
        return integrand(local, value.f, hit.light) / pdf;
    }

    const Scene& scene_;
    const Probe& probe_;
    Strategy s_;
    Frame<double> frame_;
    Vec wo_;
    std::vector<double> solid_angle_, irradiance_, probability_;
    std::function<BsdfValue<double>(const Vec&, const Vec&)> f_;
    std::function<Vec(const Vec&, double, Vec2<double>)> draw_;
    std::mt19937_64 random_{7};
};

}  // namespace mis::naive
