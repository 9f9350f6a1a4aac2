#include "mis/effects/effects.h"

#include "mis/bsdf/any_bsdf.h"
#include "mis/scene/material_fields.h"

#include <algorithm>

namespace mis {

namespace {
bool is_grey(const Vec3<double>& rgb) { return rgb.x == rgb.y && rgb.y == rgb.z; }

template <class... Bs> constexpr bool all_described(TypeList<Bs...>)
{
    return ((find_material_type(Bs::name) != nullptr) && ...);
}
static_assert(all_described(Bsdfs{}), "what a BSDF reads is in scene/material_fields.h");
}  // namespace

bool are_grey(const Lights& lights)
{
    return std::all_of(lights.begin(), lights.end(), [](const Light& light) {
        return is_grey(vec_cast<double>(light.radiance_radius));
    });
}

bool is_grey(const Material& material)
{
    const MaterialType* const type = find_material_type(material.type);
    return type != nullptr && std::ranges::all_of(type->fields, [&](const MaterialField& field) {
               return field.color == nullptr || is_grey(material.*field.color);
           });
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
    effects.on.set(Effect::shadows, !scene.surfaces.empty());
    effects.on.set(Effect::light_occlusion, scene.lights.size() > 1);
    effects.on.set(Effect::choice, scene.lights.size() > 1);
    effects.on.set(Effect::colour,
                   !are_grey(scene.lights) ||
                       !std::ranges::all_of(scene.materials, [](const Material& material) {
                           return is_grey(material);
                       }));
    effects.by_tile = true;
    return effects;
}

namespace {

std::string counted(std::size_t n, const std::string& one)
{
    return std::to_string(n) + " " + one + (n == 1 ? "" : "s");
}

/// Why an effect is on or off, in words that follow that.
struct Words {
    std::string nowhere;    ///< the scene does not call for it
    std::string somewhere;  ///< some tiles do
    std::string no_tile;    ///< the scene could, but no tile does
};

Words words(Effect effect, const Scene& scene, double share)
{
    const auto elsewhere = [&](const char* what) {
        return share < 1 ? std::string("; elsewhere ") + what : "";
    };
    switch (effect) {
        case Effect::shadows:
            return {"no surface, so nothing stands before a light: no shadow ray is traced",
                    counted(scene.surfaces.size(), "surface") + " may stand before a light" +
                        elsewhere("a plane parts every surface from all that lies between"),
                    "from no tile does a surface stand before a light: no shadow ray is traced"};
        case Effect::light_occlusion:
            return {"one light, so no other can stand before it",
                    counted(scene.lights.size(), "light") + " may stand before one another" +
                        elsewhere("a plane parts each light from the ways to the others"),
                    "from no tile does a light stand before another"};
        case Effect::horizon:
            return {
                "no point's horizon matters",
                "the horizon may cut or hide lights" + elsewhere("all lights are wholly above it"),
                "from every tile all lights are wholly above the horizon"};
        case Effect::specular:
            return {"no material has a lobe",
                    "materials have a lobe beside their diffuse part" +
                        elsewhere("there is none, or it is black"),
                    "no material in view has a lobe that is not black"};
        case Effect::choice:
            return {"one light, so there is no choice to make",
                    "one of " + counted(scene.lights.size(), "light") + " is chosen",
                    "one light, so there is no choice to make"};
        case Effect::colour:
            return {
                "lights and materials are grey: one channel is added up for all three",
                "lights or materials are coloured" + elsewhere("both are grey"),
                "lights, and materials in view, are grey: one channel is added up for all three"};
    }
    return {};
}

EffectPlan plan(Effect effect, const Scene& scene, bool is_called_for, double share)
{
    const Words why = words(effect, scene, share);
    if (!is_called_for) return {name_of(effect), false, 0, why.nowhere};
    if (share == 0) return {name_of(effect), false, 0, why.no_tile};
    return {name_of(effect), true, share, why.somewhere};
}

}  // namespace

std::vector<EffectPlan> explained(const Scene& scene, const Effects& effects,
                                  const EffectShares& shares)
{
    std::vector<EffectPlan> plans;
    for (const Effect effect : EffectSet::all())
        plans.push_back(
            effects.by_tile
                ? plan(effect, scene, effects.on.has(effect), shares[effect])
                : EffectPlan{name_of(effect), true, 1, "nothing is left out (--effects all)"});
    return plans;
}

}  // namespace mis
