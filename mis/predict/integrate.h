#pragma once

#include "mis/predict/evaluate.h"

#include <span>
#include <vector>

namespace mis {

/// A vector of integrals, each with a bound of its error.
struct Integrals {
    std::vector<double> value, error;
};

/// How hard to try.
struct Effort {
    std::vector<double>
        tolerance;  ///< of each integral, absolute; empty: one rule per stretch, no refinement
    int max_halvings = 26;  ///< of an interval, in either direction
    std::size_t max_meridians =
        20'000;  ///< of a patch; what is beyond is left with the error it has
};

/// Integrates a group over a patch: along meridians, each cut where anything jumps, and around the
/// pole, cut at the azimuths where a meridian meets other things (docs/theory-predict.md, P11).
/// azimuths: of azimuths_of().
Integrals integrate(const Patch& patch, Evaluator& evaluator, const Group& group,
                    std::span<const double> azimuths, std::size_t size, const Effort& effort);

/// Where to cut around the pole, ascending: the patch's own azimuths, and those at which the
/// group's weights jump.
std::vector<double> azimuths_of(const Patch& patch, Evaluator& evaluator, const Group& group);

}  // namespace mis
