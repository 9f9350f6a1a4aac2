#pragma once

#include "mis/scene/scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mis {

/// What must be simulated on a scene; what provably changes no value may be left out. Plain data.
/// Effects never change a probability, a draw, a density or the random numbers.
struct Effects {
    std::size_t lights = 0;       ///< of the scene
    bool shadows = true;          ///< surfaces that could hide a light
    bool light_occlusion = true;  ///< lights that could hide one another
};

/// One effect, as `explain` and the report show it.
struct EffectPlan {
    std::string name;  ///< "shadows", …
    bool on;           ///< is it simulated?
    std::string why;   ///< in words
};

/// Everything that a scene could call for.
Effects all_effects(const Scene& scene);

/// Only what this scene calls for.
Effects called_for(const Scene& scene);

/// The same in words, one per effect, in a fixed order.
std::vector<EffectPlan> explained(const Scene& scene, const Effects& effects);

}  // namespace mis
