#pragma once

#include "mis/sampling/number_source.h"
#include "mis/strategy/strategy.h"

namespace mis {

/// Does the variance of this strategy depend on how many samples a point gets? It does where the
/// samples of one point are not independent: an observation is then the mean of n of them
/// (docs/theory.md (70)). All of a study asks here.
inline bool depends_on_count(const Strategy& strategy, const NumberSource& numbers)
{
    return strategy.model == Model::strata || numbers.is_sobol();
}

/// How many samples have their numbers from one sequence: 1 where they are independent.
inline int samples_per_scrambling(const NumberSource& numbers)
{
    return numbers.is_sobol() ? static_cast<int>(numbers.samples_per_scrambling) : 1;
}

/// How many samples are one observation.
inline int samples_per_observation(const Strategy& strategy, const NumberSource& numbers)
{
    return strategy.model == Model::strata ? samples_together(strategy)
                                           : samples_per_scrambling(numbers);
}

}  // namespace mis
