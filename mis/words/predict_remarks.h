#pragma once

#include "mis/report/interval.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mis {

/// What quadrature found of the strategies at the probes that it could answer for.
struct PredictedVariances {
    struct AtProbe {
        std::size_t number = 0;     ///< of the probe
        std::vector<double> means;  ///< of each strategy
        std::vector<Interval>
            variances;  ///< of each strategy, with bounds; infinite beyond a double
    };
    std::vector<std::string> strategies;
    std::vector<AtProbe> probes;
    std::size_t all_probes = 0;  ///< of the scene, with those that it could not answer for
};

/// Which strategy has the least variance, by how much and over which probes; which are exact, and
/// which cannot be told apart within the bounds. Nothing without probes.
std::vector<std::string> sentences_of(const PredictedVariances& found);

}  // namespace mis
