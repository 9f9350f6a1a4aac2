#pragma once

#include "mis/scene/scene.h"

#include <array>
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
    bool horizon = true;          ///< lights that some point's horizon may cut or hide
    bool specular = true;         ///< a lobe beside a material's diffuse part
    bool choice = true;           ///< a light is one of several
    bool colour = true;           ///< lights or materials other than grey
    bool by_tile = false;  ///< asked again for every tile (effects/tile_plan.h) and its material
};

/// Nothing is simulated but drawing and weighing.
inline constexpr Effects no_effects{0, false, false, false, false, false, false, false};

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

/// What effects are called, in the order in which they are explained.
inline constexpr std::array effect_names{"shadows",  "light_occlusion", "horizon",
                                         "specular", "choice",          "colour"};

/// Has the BSDF of some surface or probe a lobe beside its diffuse part?
bool has_lobes(const Scene& scene);

/// Are all of one grey each, so that what one channel shows is true of all three?
bool are_grey(const Lights& lights);
/// Is it of one grey?
bool is_grey(const Material& material);

/// How many tiles call for an effect; or, of all tiles, which share.
struct EffectShares {
    double shadows = 0;          ///< surfaces
    double light_occlusion = 0;  ///< lights before lights
    double horizon = 0;          ///< lights not wholly above it
    double specular = 0;         ///< a lobe
    double choice = 0;           ///< several lights
    double colour = 0;           ///< other than grey

    /// All of them.
    static constexpr std::array<double EffectShares::*, 6> each();
    /// Adds others, one by one.
    void add(const EffectShares& other)
    {
        for (double EffectShares::*share : each()) this->*share += other.*share;
    }
    /// Shares of so many tiles; of none, 0.
    EffectShares of(std::size_t tiles) const
    {
        EffectShares shares = *this;
        for (double EffectShares::*share : each())
            shares.*share /= static_cast<double>(tiles > 0 ? tiles : 1);
        return shares;
    }
};
constexpr std::array<double EffectShares::*, 6> EffectShares::each()
{
    return {&EffectShares::shadows,  &EffectShares::light_occlusion, &EffectShares::horizon,
            &EffectShares::specular, &EffectShares::choice,          &EffectShares::colour};
}

/// The same in words, one per effect, in a fixed order.
std::vector<EffectPlan> explained(const Scene& scene, const Effects& effects,
                                  const EffectShares& shares);

}  // namespace mis
