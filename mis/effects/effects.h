#pragma once

#include "mis/scene/scene.h"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace mis {

/// What must be simulated on a scene; what provably changes no value may be left out. Plain data.
/// Effects never change a probability, a draw, a density or the random numbers.
struct Effects {
    std::size_t lights = 0;       ///< of the scene
    bool shadows = true;          ///< surfaces that could hide a light
    bool light_occlusion = true;  ///< lights that could hide one another
    bool by_tile = false;         ///< asked again for every tile (effects/tile_plan.h)
};

/// One effect, as `explain` and the report show it.
struct EffectPlan {
    std::string name;  ///< "shadows", …
    bool on;           ///< is it simulated?
    double share;      ///< of the tiles that call for it
    std::string why;   ///< in words
    /// What leaving it out where it is not called for saves a sample; NaN: not measured.
    double saved_rays_per_sample = std::numeric_limits<double>::quiet_NaN();
    /// CPU seconds; NaN: not measured.
    double saved_seconds_per_sample = std::numeric_limits<double>::quiet_NaN();
};

/// Everything that a scene could call for.
Effects all_effects(const Scene& scene);

/// Only what this scene calls for, and of that, what each tile does.
Effects called_for(const Scene& scene);

/// Of all tiles, how many call for an effect.
struct EffectShares {
    double shadows = 1;          ///< surfaces
    double light_occlusion = 1;  ///< lights
};

/// The same in words, one per effect, in a fixed order.
std::vector<EffectPlan> explained(const Scene& scene, const Effects& effects,
                                  const EffectShares& shares);

}  // namespace mis
