#pragma once

#include "mis/engine/scalar_choices.h"
#include "mis/strategy/strategy.h"

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mis {

/// Is the variance of a strategy a sum over single directions? That of `strata` is not.
inline bool can_share(const Strategy& strategy) { return strategy.model != Model::strata; }

/// The place of a name in a list, at whose end it is put where it is missing.
std::size_t place_of(std::string_view name, std::vector<std::string>& names);

/// What some strategies share, so that each density is found once per direction: their policies,
/// their techniques, and the pairs of these.
struct SharedPlan {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    /// Of light draws. policy: none where every light is drawn.
    struct Density {
        std::size_t policy, technique;
    };
    struct Entry {
        Strategy strategy;
        std::size_t density = none;  ///< none where no light is chosen
        std::size_t every = none;    ///< among the strategies that draw every light
        ScalarHeuristic heuristic;
        ScalarTechnique direction;  ///< where no light is chosen
        /// Draws per sample, as heuristics count them; ½ each in the one-sample model.
        double light = 0, bsdf = 0;
        /// Independent draws that a sample adds up, at least 1; of the one-sample model, its one.
        double light_draws = 1, bsdf_draws = 1;
        /// How often such a draw is of this technique: 1, or ½.
        double light_share = 1, bsdf_share = 1;
        bool sums_lights = false;  ///< of the light technique
        bool is_one_sample = false;
    };

    explicit SharedPlan(std::span<const Strategy> strategies);

    std::vector<std::string> policies;  ///< that choose a light
    std::vector<std::string> technique_names;
    std::vector<ScalarTechnique> techniques;  ///< of light draws
    std::vector<Density> densities;
    std::vector<Entry> entries;   ///< as the strategies
    std::size_t every_light = 0;  ///< strategies that draw every light
    bool asks_all_along = false;  ///< some density is a sum over all lights along a direction
};

}  // namespace mis
