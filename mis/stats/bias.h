#pragma once

#include "mis/report/reason.h"
#include "mis/stats/measurements.h"

#include <span>
#include <vector>

namespace mis {

/// A mean of float samples may be off by this much of itself and still be right.
inline constexpr double rounding_of_means = 4e-6;

/// How one strategy's mean stands against the others'.
struct BiasFinding {
    bool biased = false;
    bool too_low = false;          ///< below the others wherever it differs, where biased
    bool only_in_regions = false;  ///< and not over the whole image, where biased
    double p_value = 1;  ///< corrected for all strategies and regions; 1 if nothing could be tested
    reason::MeanDiffers why = {};  ///< where biased
    double relative_excess = 0;    ///< the most that it is above the others, over their mean
};

/// A region is tested where so many samples carry the variance of each of the means compared there.
inline constexpr double least_region_participation = 30;

/// A mean that is too high may lack rare *dim* samples (a light that is all but always chosen hides
/// how little the others would give): n samples that never drew them leave them a probability of up
/// to this over n (once in 1000 more), by which part of itself a mean of positive samples can then
/// be too high. That is not resolved rather than biased.
inline constexpr double most_never_drawn = 7;

/// A mean that is too low may lack rare samples that were never drawn; then it is not resolved
/// rather than biased. So it may be where no audit was made and fewer samples than this carry the
/// variance; and where it is low in some regions alone, as the audit is of the whole image, which a
/// dark corner hardly changes. What is low over the whole image past an audit lacks nothing: it is
/// biased. Of two strategies that differ, one that may lack rare samples does not condemn the
/// other.
inline constexpr double least_participation_without_audit = 1000;
bool may_lack_rare_samples(const BiasFinding& finding, const StrategyMeasurements& strategy);

/// Tests the mean of each of `strategies` (all resolved), over the image and in each region,
/// against a reference pooled from the others. Strategies share random numbers, so the standard
/// error is that of the difference, from the replicates (Student's t). Samples are skewed, which
/// makes a t test of a mean too quick to call it low; Hall's (1992) transformation, with the
/// largest skewness that the participation allows, undoes that. The worst is taken out and the rest
/// tested anew, so that one biased strategy does not condemn the others; of two that differ,
/// neither is trusted. error: the probability that any of them is called biased and is not
/// (Bonferroni over strategies and regions). Differences within
/// rounding_of_means are no bias.
std::vector<BiasFinding> find_bias(std::span<const StrategyMeasurements* const> strategies,
                                   double error);

/// The same by the mean of shared directions, where each strategy has mean_checks: over the image
/// and in each region. The error of its own mean is by its true variance, so that it may be low by
/// rare samples without being called so; it is called high only where many samples carry that.
std::vector<BiasFinding> find_bias_beside_shared(
    std::span<const StrategyMeasurements* const> strategies, double error);

/// The least bias of the image's mean, relative to it, that such a test would all but surely find
/// as one of `tests` tests that share that error; NaN where nothing is known.
double least_detectable_bias(const StrategyMeasurements& strategy, double error, double tests);

}  // namespace mis
