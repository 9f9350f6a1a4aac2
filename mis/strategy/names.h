#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mis {

/// A registered choice, as help texts and messages show it.
struct Choosable {
    std::string name, summary;
};

/// What the registries list, in their order.
const std::vector<Choosable>& policy_names();
const std::vector<Choosable>& heuristic_names();
const std::vector<Choosable>& technique_names();

/// Does this policy draw every light for one sample, in place of choosing one?
bool draws_every_light(std::string_view policy);

/// Does this policy look at all lights at every shading point, in time linear in their number?
bool reads_all_lights(std::string_view policy);

}  // namespace mis
