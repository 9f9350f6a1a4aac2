#pragma once

#include "mis/predict/rule.h"

#include <string_view>
#include <vector>

namespace mis {

/// A heuristic by name: the weights of a light and a BSDF draw from both densities, node by node,
/// and the ratios (BSDF density over light density) at which they jump.
struct WeightRule {
    void (*weigh)(const NodeColumn& light_density, const NodeColumn& bsdf_density,
                  NodeColumn& light_weight, NodeColumn& bsdf_weight);
    std::vector<double> jumps;
};

/// Of the registry. Throws std::out_of_range for an unknown name.
const WeightRule& weight_rule(std::string_view heuristic);

}  // namespace mis
