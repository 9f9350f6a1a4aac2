#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mis {

/// A registered choice, as help texts and messages show it.
struct Choosable {
    std::string name;     ///< "power", …
    std::string summary;  ///< half a sentence
    /// Is it ranked where nothing is named, on a scene of so many lights, on whose surfaces some
    /// BSDF has a lobe or none has? nullptr: never.
    bool (*ranked_by_default)(std::size_t lights, bool has_lobes) = nullptr;
    /// Of a technique: the strategy's policy and heuristic with which it is; empty: with none.
    std::string ranked_by_default_with = {};
};

/// What the registry of policies lists, in its order.
const std::vector<Choosable>& policy_names();
/// Those of the heuristics.
const std::vector<Choosable>& heuristic_names();
/// Those of the techniques.
const std::vector<Choosable>& technique_names();

/// The names of those that say that they are ranked by default on such a scene, in their order.
std::vector<std::string> ranked_by_default(const std::vector<Choosable>& list, std::size_t lights,
                                           bool has_lobes);

/// The names of strategies beside policies × heuristics that are ranked where nothing is named: of
/// techniques that say so, each by itself or with the policy and heuristic that it names.
std::vector<std::string> strategies_ranked_by_default(std::size_t lights, bool has_lobes);

/// Does this technique draw towards a light that a policy chose?
bool chooses_light(std::string_view technique);

/// Does this policy draw every light for one sample, in place of choosing one?
bool draws_every_light(std::string_view policy);

/// Does this policy look at all lights at every shading point, in time linear in their number?
bool reads_all_lights(std::string_view policy);

/// Does it weigh lights by what they would give a surface without a lobe that nothing shades?
bool weighs_by_irradiance(std::string_view policy);

/// Does this technique draw a light's directions in proportion to their cosine?
bool draws_by_irradiance(std::string_view technique);

}  // namespace mis
