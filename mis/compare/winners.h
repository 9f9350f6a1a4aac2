#pragma once

#include "mis/compare/measurements.h"
#include "mis/run/executor.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace mis {

/// Of all places that are given a winner, at most this share has a wrong one, in expectation.
inline constexpr double false_winners = 0.05;

/// What one strategy's samples came to at the shading points of one place.
struct PlaceSamples {
    std::uint64_t samples = 0;
    double variance = 0;            ///< of one sample, summed over the points
    double mean = 0, mean_se2 = 0;  ///< and its squared standard error, summed over the points
    double squared_means = 0;       ///< μ², summed over the points
    Participation participation;    ///< in `variance`

    void add(const Moments& point);
};

/// The strategy of least variance × cost at every place, or −1 where that is undecided. at(place,
/// strategy): its samples. costs: [strategy], > 0; all 1 for the variance alone. groups:
/// [strategy]; it must surely lead those of other groups alone, so that twins do not keep a place
/// undecided.
/// A place's p-value is the number of strategies times that of its closest pair, by Student's t on
/// the difference of log variances (docs/theory.md, eq. 72); winners are then told by Benjamini and
/// Hochberg (1995), for `false_winners`. Undecided, too, is a place where the best one's variance
/// is carried by fewer than ten samples (pool.h), or another's by fewer than four, as where it
/// never met a light, and one where the best one's mean is four standard errors from another's: it
/// missed something.
std::vector<int> winners_of(
    std::size_t places, const std::vector<double>& costs, const std::vector<int>& groups,
    const std::function<PlaceSamples(std::size_t place, std::size_t strategy)>& at,
    const AnyExecutor& executor);

/// Pixels along the side of the squares that winners are told for: the smallest of 1, 2, 4, 8 and
/// 16 that has two thousand samples of each strategy, where each pixel has so many.
int winner_square(double samples_per_pixel);

}  // namespace mis
