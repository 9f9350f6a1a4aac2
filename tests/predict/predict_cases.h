#pragma once

#include "mis/predict/predict.h"
#include "mis/strategy/names.h"

#include <cmath>
#include <random>
#include <string_view>
#include <vector>

namespace mis {

/// The strategies of some names.
inline std::vector<Strategy> strategies_of(std::vector<std::string_view> names)
{
    std::vector<Strategy> all;
    for (const std::string_view name : names) all.push_back(parse_strategy(name));
    return all;
}

/// Every policy × heuristic × technique × model that has a meaning, with one draw each, and those
/// that choose no light.
inline std::vector<Strategy> every_plain_strategy()
{
    std::vector<Strategy> all = strategies_of({"brdf", "cosine", "hemisphere"});
    for (const Choosable& policy : policy_names())
        for (const Choosable& heuristic : heuristic_names())
            for (const Choosable& technique : technique_names())
                for (const Model model : {Model::multi, Model::one_sample}) {
                    Strategy s{.policy = policy.name,
                               .heuristic = heuristic.name,
                               .technique = technique.name};
                    s.model = model;
                    if (heuristic.name == "light") s.counts = {1, 0};
                    try {
                        all.push_back(checked(s));
                    } catch (const StrategyError&) {
                    }
                }
    return all;
}

inline Predicted predict_one(const Scene& scene, std::string_view strategy)
{
    const Strategy s = parse_strategy(strategy);
    return predict(scene, scene.probes.front(), std::span(&s, 1)).front();
}

/// All samples are worth the same, but for rounding: variances have no digits then.
inline bool is_exact(const Predicted& p) { return p.variance < 1e-24 * p.mean * p.mean; }

/// The unit vector at angle θ from +z, azimuth φ.
inline Vec3<double> direction(double theta, double phi = 0)
{
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

inline Material lambert(double albedo)
{
    Material material;
    material.diffuse = Vec3<double>(albedo);
    return material;
}

/// A probe at the origin, normal +z, that looks up at `outgoing`; no lights yet.
inline Scene empty_scene(const Material& material, const Vec3<double>& outgoing = {0, 0, 1})
{
    Scene scene;
    scene.materials.push_back(material);
    scene.probes.push_back({Vec3<double>(0), Vec3<double>(0, 0, 1), outgoing, 0});
    return scene;
}

/// A grey light whose cap has this half-angle about a direction; at distance 2 unless said
/// otherwise.
inline Light light_at(const Vec3<double>& towards, double half_angle, double radiance,
                      double distance = 2)
{
    return make_light(towards * distance, distance * std::sin(half_angle), Vec3<double>(radiance));
}

/// A small scene at random: a surface of any type, tilted; one to five lights of all sizes, some
/// below the horizon, many of whose caps overlap and some of which interlock; in every third scene
/// a sphere that occludes.
inline Scene random_scene(unsigned seed)
{
    std::mt19937 random(seed);
    const auto u = [&](double low, double high) {
        return low + (high - low) * std::generate_canonical<double, 53>(random);
    };
    const auto any = [&] {
        const double x = u(-1, 1), y = u(-1, 1), z = u(-1, 1);
        return glm::normalize(Vec3<double>(x, y, z));
    };
    Material material;
    material.type = std::vector<std::string>{"lambert", "blinn", "ggx", "lecture"}[seed % 4];
    // One draw after the other: the order of arguments is the compiler's choice.
    const double green = u(0.05, 0.5), red = u(0.05, 0.5);
    material.diffuse = {red, green, 0.2};
    if (seed % 4 != 0) {
        const double blue = u(0.1, 0.5);
        material.specular = {u(0.1, 0.5), 0.3, blue};
    }
    material.exponent = std::pow(10, u(0, 2.7));
    material.alpha = u(0.03, 0.7);
    Scene scene;
    scene.materials.push_back(material);
    const Vec3<double> x = any(), n = any();
    scene.probes.push_back({x, n, glm::normalize(n + 0.9 * any()), 0});
    const auto place = [&](double& radius) {
        Vec3<double> d;
        do d = glm::normalize(any() + 0.6 * n);
        while (dot(d, n) < -0.3);
        const double distance = u(1, 4);
        radius = distance * std::pow(10, u(-1.5, -0.1));
        return x + d * distance;
    };
    double radius = 0;
    for (int lights = 1 + int(u(0, 5)); lights > 0; --lights) {
        const Vec3<double> center = place(radius);
        scene.lights.push_back(make_light(center, radius, {u(0, 5), u(0, 5), u(0, 5)}));
    }
    if (seed % 3 == 0) {
        const Vec3<double> center = place(radius);
        scene.surfaces.push_back({SphereSurface{center, 0.7 * radius}, 0});
    }
    return scene;
}

}  // namespace mis
