#pragma once

#include "mis/stats/measurements.h"

namespace mis {

/// Samples of one value, each rounded to float on its way, differ by so much of it: their standard
/// deviation over their mean. docs/theory.md §13, "Exact".
inline constexpr double rounding_of_samples = 0x1p-20;

/// At a single point, whose variance few samples may tell, by so many times as much.
inline constexpr double rounding_of_a_point = 8 * rounding_of_samples;

/// What is proved to be one value may differ by this: weights of lights are themselves rounded.
inline constexpr double rounding_of_proved_samples = 4e-6;

/// On what grounds a strategy is called exact, of zero variance.
enum class Exactness {
    none,        ///< it is not
    by_samples,  ///< every sample agrees with its point's mean to rounding, and nothing refutes it
    by_proof     ///< every sample is the answer by a theorem, and agrees with it to rounding
};

/// Is it exact, and why? By samples it is not where some point was 0 in all of them, nor where only
/// its own samples speak for it: it takes an audit, or a draw of every light.
Exactness exactness_of(const StrategyMeasurements& strategy);

/// Is what its samples differ by no more than rounding, so that its variance is no figure?
bool is_within_rounding(const PooledFigures& pooled);

}  // namespace mis
