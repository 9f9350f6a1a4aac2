#include "mis/effects/effects.h"

namespace mis {

Effects all_effects(const Scene& scene) { return {.lights = scene.lights.size()}; }

Effects called_for(const Scene& scene)
{
    Effects effects = all_effects(scene);
    effects.shadows = !scene.surfaces.empty();
    effects.light_occlusion = scene.lights.size() > 1;
    return effects;
}

std::vector<EffectPlan> explained(const Scene& scene, const Effects& effects)
{
    const std::string surfaces = std::to_string(scene.surfaces.size());
    const std::string lights = std::to_string(scene.lights.size());
    return {
        {"shadows", effects.shadows,
         effects.shadows ? surfaces + (scene.surfaces.size() == 1 ? " surface" : " surfaces") +
                               " may stand before a light"
                         : "no surface, so nothing stands before a light: no shadow ray is traced"},
        {"light_occlusion", effects.light_occlusion,
         effects.light_occlusion ? lights + " lights may stand before one another"
                                 : "one light, so no other can stand before it"},
    };
}

}  // namespace mis
