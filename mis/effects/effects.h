#pragma once

#include "mis/effects/effect.h"
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
    std::size_t lights = 0;           ///< of the scene
    EffectSet on = EffectSet::all();  ///< what is simulated
    bool by_tile = false;  ///< asked again for every tile (effects/tile_plan.h) and its material
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

/// Has the BSDF of some surface or probe a lobe beside its diffuse part?
bool has_lobes(const Scene& scene);

/// Are all of one grey each, so that what one channel shows is true of all three?
bool are_grey(const Lights& lights);
/// Is every colour that its type reads a grey?
bool is_grey(const Material& material);

/// How many tiles call for each effect; or, of all tiles, which share.
class EffectShares {
public:
    /// Tiles, or the share of them.
    double& operator[](Effect effect) { return shares_[static_cast<std::size_t>(effect)]; }
    /// The same.
    double operator[](Effect effect) const { return shares_[static_cast<std::size_t>(effect)]; }
    /// Counts a tile that calls for these.
    void add(EffectSet called_for)
    {
        for (const Effect effect : called_for) (*this)[effect] += 1;
    }
    /// Adds others, one by one.
    void add(const EffectShares& other)
    {
        for (const Effect effect : EffectSet::all()) (*this)[effect] += other[effect];
    }
    /// Shares of so many tiles; of none, 0.
    EffectShares of(std::size_t tiles) const
    {
        EffectShares shares = *this;
        for (double& share : shares.shares_) share /= static_cast<double>(tiles > 0 ? tiles : 1);
        return shares;
    }

private:
    std::array<double, effect_count> shares_{};
};

/// The same in words, one per effect, in a fixed order.
std::vector<EffectPlan> explained(const Scene& scene, const Effects& effects,
                                  const EffectShares& shares);

}  // namespace mis
