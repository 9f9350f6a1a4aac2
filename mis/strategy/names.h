#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mis {

/// A registered choice, as help texts and messages show it.
struct Choosable {
    std::string name;     ///< "power", …
    std::string summary;  ///< half a sentence
};

/// What the registry of policies lists, in its order.
const std::vector<Choosable>& policy_names();
/// Those of the heuristics.
const std::vector<Choosable>& heuristic_names();
/// Those of the techniques.
const std::vector<Choosable>& technique_names();

/// Does this policy draw every light for one sample, in place of choosing one?
bool draws_every_light(std::string_view policy);

/// Does this policy look at all lights at every shading point, in time linear in their number?
bool reads_all_lights(std::string_view policy);

/// Does it weigh lights by what they would give a surface without a lobe that nothing shades?
bool weighs_by_irradiance(std::string_view policy);

/// Does this technique draw a light's directions in proportion to their cosine?
bool draws_by_irradiance(std::string_view technique);

}  // namespace mis
