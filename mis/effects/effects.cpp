#include "mis/effects/effects.h"

namespace mis {

Effects all_effects(const Scene& scene) { return {.lights = scene.lights.size()}; }

Effects called_for(const Scene& scene)
{
    Effects effects = all_effects(scene);
    effects.shadows = !scene.surfaces.empty();
    effects.light_occlusion = scene.lights.size() > 1;
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

}  // namespace

std::vector<EffectPlan> explained(const Scene& scene, const Effects& effects,
                                  const EffectShares& shares)
{
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
    };
}

}  // namespace mis
