#pragma once

#include "mis/stats/measurements.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mis {

/// What one strategy's samples came to at the shading points of one place.
struct PlaceSamples {
    std::uint64_t samples = 0;
    double variance = 0;            ///< of one sample, summed over the points
    double mean = 0, mean_se2 = 0;  ///< and its squared standard error, summed over the points
    double squared_means = 0;       ///< μ², summed over the points
    Participation participation;    ///< in `variance`

    void add(const Moments& point);
    /// Where the variance of one sample is known apart from the samples. Not to be mixed with the
    /// other.
    void add(const Moments& point, const ValueAndError& known);
};

/// Those that may win a place. costs: > 0 of each strategy; all 1 for the variance alone. groups:
/// of each strategy; it must surely lead those of other groups alone, so that twins do not keep a
/// place undecided.
struct Contest {
    std::vector<double> costs;
    std::vector<int> groups;

    /// Are there two that do not belong together?
    bool is_contest() const;
};

/// A place's best strategy, or −1, and how surprising its lead is if another is as good.
struct Candidate {
    int strategy = -1;
    double p = 1;
};

/// The strategy of least variance × cost at a place. samples: of each strategy there. The p-value
/// is the number of strategies times that of its closest pair, by Student's t on the difference of
/// log variances (docs/theory.md, eq. 72). There is none where the best one's variance is carried
/// by fewer than ten samples (pool.h), or another's by fewer than four, as where it never met a
/// light; and none where the best one's mean is four standard errors from another's: it missed
/// something; nor where there is no contest.
Candidate candidate(std::span<const PlaceSamples> samples, const Contest& contest);

/// The winner of every place, or −1 where that is undecided: told by Benjamini and Hochberg (1995),
/// for `false_winners`.
std::vector<int> winners_of(std::span<const Candidate> places);

/// Pixels along the side of the squares that winners are told for: the smallest of 1, 2, 4, 8 and
/// 16 that has two thousand samples of each strategy, where each pixel has so many.
int winner_square(double samples_per_pixel);

}  // namespace mis
