#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mis {

/// multi: every technique draws, each draw weighed (Veach 1997, §9.2.1).
/// one_sample: one technique is drawn, with probability ½ each (§9.2.4).
enum class Model { multi, one_sample };

/// What is ranked: policy + technique + heuristic + model + counts, as data (docs: design of a
/// strategy's name). A strategy that chooses no light ("brdf", "cosine", "hemisphere") has an empty
/// policy and heuristic.
struct Strategy {
    std::string policy;     ///< of the registry
    std::string heuristic;  ///< "light" for a light draw alone
    std::string technique =
        "cone";  ///< of the light draw; or the whole strategy where no light is chosen
    Model model = Model::multi;  ///< §9.2.1 or §9.2.4
    std::array<int, 2> counts{
        1, 1};  ///< light draws (for each light, with `all`) and BSDF draws per sample

    /// Does it draw towards lights at all?
    bool chooses_light() const { return !policy.empty(); }
    /// Are all members equal?
    bool operator==(const Strategy&) const = default;
};

/// A strategy that has no meaning, or a name that is not known. what() says which, why, and what is
/// allowed.
struct StrategyError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// "solid-angle/power", "power/balance/union", "irradiance/balance@4+1": what is default is left
/// out.
std::string name_of(const Strategy& strategy);

/// The strategy of that name. Throws StrategyError.
Strategy parse_strategy(std::string_view name);

/// `strategy`, if it has a meaning. Throws StrategyError with the reason if not.
Strategy checked(Strategy strategy);

}  // namespace mis
