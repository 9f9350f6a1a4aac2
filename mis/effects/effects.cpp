#include "mis/effects/effects.h"

#include "mis/bsdf/any_bsdf.h"

#include <algorithm>

namespace mis {

namespace {
bool is_grey(const Vec3<double>& rgb) { return rgb.x == rgb.y && rgb.y == rgb.z; }
}  // namespace

bool are_grey(const Lights& lights)
{
    return std::all_of(lights.begin(), lights.end(), [](const Light& light) {
        return is_grey(vec_cast<double>(light.radiance_radius));
    });
}

bool is_grey(const Material& material)
{
    return is_grey(material.diffuse) && is_grey(material.specular);
}

bool has_lobes(const Scene& scene)
{
    const auto has_lobe = [&](const auto& owner) {
        const Material& material = scene.materials[static_cast<std::size_t>(owner.material)];
        const std::shared_ptr<const void> bsdf = make_bsdf(material);
        return !is_diffuse(AnyBsdf{bsdf.get(), bsdf_number(material.type)});
    };
    return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), has_lobe) ||
           std::any_of(scene.probes.begin(), scene.probes.end(), has_lobe);
}

Effects all_effects(const Scene& scene) { return {.lights = scene.lights.size()}; }

Effects called_for(const Scene& scene)
{
    Effects effects = all_effects(scene);
    effects.shadows = !scene.surfaces.empty();
    effects.light_occlusion = effects.choice = scene.lights.size() > 1;
    effects.colour = !are_grey(scene.lights) ||
                     std::any_of(scene.materials.begin(), scene.materials.end(),
                                 [](const Material& material) { return !is_grey(material); });
    effects.by_tile = true;
    return effects;
}

namespace {

std::string counted(std::size_t n, const std::string& one)
{
    return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
}

/// In words that follow "on" or "off": for the scene, or for its tiles.
EffectPlan plan(const std::string& name, bool on, double share, const std::string& nowhere,
                const std::string& somewhere, const std::string& no_tile)
{
    if (!on) return {name, false, 0, nowhere};
    if (share == 0) return {name, false, 0, no_tile};
    return {name, true, share, somewhere};
}

std::vector<EffectPlan> nothing_left_out()
{
    std::vector<EffectPlan> all;
    for (const char* name : effect_names)
        all.push_back({name, true, 1, "nothing is left out (--effects all)"});
    return all;
}

}  // namespace

std::vector<EffectPlan> explained(const Scene& scene, const Effects& effects,
                                  const EffectShares& shares)
{
    if (!effects.by_tile) return nothing_left_out();
    const std::string elsewhere =
        shares.shadows < 1 ? "; elsewhere a plane parts every surface from all that lies between"
                           : "";
    const std::string apart =
        shares.light_occlusion < 1
            ? "; elsewhere a plane parts each light from the ways to the others"
            : "";
    return {
        plan("shadows", effects.shadows, shares.shadows,
             "no surface, so nothing stands before a light: no shadow ray is traced",
             counted(scene.surfaces.size(), "surface") + " may stand before a light" + elsewhere,
             "from no tile does a surface stand before a light: no shadow ray is traced"),
        plan("light_occlusion", effects.light_occlusion, shares.light_occlusion,
             "one light, so no other can stand before it",
             counted(scene.lights.size(), "light") + " may stand before one another" + apart,
             "from no tile does a light stand before another"),
        plan("horizon", effects.horizon, shares.horizon, "no point's horizon matters",
             std::string("the horizon may cut or hide lights") +
                 (shares.horizon < 1 ? "; elsewhere all lights are wholly above it" : ""),
             "from every tile all lights are wholly above the horizon"),
        plan("specular", effects.specular, shares.specular, "no material has a lobe",
             std::string("materials have a lobe beside their diffuse part") +
                 (shares.specular < 1 ? "; elsewhere there is none, or it is black" : ""),
             "no material in view has a lobe that is not black"),
        plan("choice", effects.choice, shares.choice, "one light, so there is no choice to make",
             "one of " + counted(scene.lights.size(), "light") + " is chosen",
             "one light, so there is no choice to make"),
        plan("colour", effects.colour, shares.colour,
             "lights and materials are grey: one channel is added up for all three",
             std::string("lights or materials are coloured") +
                 (shares.colour < 1 ? "; elsewhere both are grey" : ""),
             "lights, and materials in view, are grey: one channel is added up for all three"),
    };
}

}  // namespace mis
