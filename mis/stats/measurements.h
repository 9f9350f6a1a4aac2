#pragma once

#include "mis/math/moments.h"
#include "mis/report/reason.h"
#include "mis/sampling/sample_name.h"
#include "mis/strategy/strategy.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mis {

// What was measured, before anything is concluded from it: filled by a study, read by rank().
// Luminance throughout.

/// A figure that was estimated without bias, and its standard error.
struct ValueAndError {
    double value = 0, se = 0;
};

/// Of every study, but where there are not two samples for each.
inline constexpr int most_replicates = 16;

/// One strategy's figures over the whole image, from the samples of one replicate alone.
/// Replicate r of every strategy uses the same shading points, and random numbers of replicate r.
struct ReplicateValues {
    double mean = 0;  ///< mean over the shading points
    double variance =
        0;  ///< mean over the points of the unbiased variance of one sample (≥ 2 samples each)
    double relative_variance =
        0;  ///< mean over the points of that variance / (μ² + ε²); μ as in pool_points()
};

/// Σ over samples of d² and of d⁴, d the distance from the mean of the sample's own point, perhaps
/// weighed per point.
struct Participation {
    double sum_d2 = 0, sum_d4 = 0;

    /// How many samples carry the variance: (Σd²)²/Σd⁴, in [1, samples]; 0 where all are equal. One
    /// over it bounds the squared relative standard error of Σd², and the squared skewness of the
    /// mean (Cauchy–Schwarz).
    double number() const { return sum_d4 > 0 ? sum_d2 * sum_d2 / sum_d4 : 0; }
};

/// From the moments of every shading point, merged over all replicates: pool_points() makes it.
struct PooledFigures {
    std::uint64_t samples = 0;             ///< over all points
    double mean = 0;                       ///< mean over the points
    double variance = 0;                   ///< mean over the points, of one sample
    double relative_variance = 0;          ///< mean over the points of variance / (μ² + ε²)
    double relative_variance_doubt = 0;    ///< how far off it may be, as μ is estimated (pool.h)
    Participation participation;           ///< in `variance`
    Participation relative_participation;  ///< in `relative_variance`
    double largest_point_share = 0;        ///< of `variance`: what the noisiest point carries
    double largest_relative_variance = 0;  ///< of a point: its variance over its squared mean
    std::size_t zero_points = 0;           ///< of which all samples are 0
    std::size_t single_points = 0;         ///< of fewer than two samples, which know no variance
    double rare_share =
        0;  ///< of `variance`: what points carry whose own participation is below 10
};

/// Rounds have numbers below this. What was observed in none has a number from here on.
inline constexpr std::uint32_t of_no_round = 1U << 31;

/// One strategy's cost, once: CPU seconds of a round *over all shading points* (so that every
/// observation is of the same work), divided by its samples, and by its points.
struct TimeObservation {
    double seconds_per_sample = 0;
    double seconds_per_point = 0;  ///< what is prepared once per point
    /// Observations of one round, of whichever strategies, were disturbed alike.
    std::uint32_t round = 0;

    /// Of one point with so many samples (docs/theory.md (32)).
    double seconds_for(double samples) const
    {
        return samples * seconds_per_sample + seconds_per_point;
    }
};

/// What the other strategies' samples say about this one's variance on some of the points: its own
/// samples cannot see what they never drew. `from_others`: an importance-weighted estimate of the
/// variance of one sample, mean over those points; `own`: the same figure from its own samples
/// there. Standard errors beside each.
struct Audit {
    bool available = false;
    double variance_from_others = 0, variance_from_others_se = 0;
    double own_variance = 0, own_variance_se = 0;
    /// The same of the relative variance (each point's divided by its μ² + ε²): what dark places
    /// hide from the above.
    bool relative_available = false;
    double relative_variance_from_others = 0, relative_variance_from_others_se = 0;
    double own_relative_variance = 0, own_relative_variance_se = 0;
};

/// One strategy's variance by directions that all strategies share, in place of its own samples'
/// (docs/theory.md §25). A turn of such directions, at every point, is a replicate.
struct SharedFigures {
    double variance = 0, relative_variance = 0;  ///< as in PooledFigures; may be below 0
    /// How far it may be off, as μ is estimated from the same directions; of one sign for all that
    /// share these.
    double relative_variance_doubt = 0;
    double relative_variance_se = 0;  ///< from the spread of the rounds at each point
    /// [replicate][region]: the same of the relative variance, each point's over a rough μ² + ε² of
    /// it, so that only their ratios count.
    std::vector<std::vector<double>> relative_region_variances;
    /// [replicate][region]: what the region adds to the replicate's variance.
    std::vector<std::vector<double>> region_variances;
    double missed = 0;                  ///< of the mean: what the strategy never draws
    std::vector<ValueAndError> probes;  ///< [probe]: variance of one sample
};

/// The mean of a strategy's own samples beside the mean of shared directions, over the image or a
/// region. The errors are independent of each other.
struct MeanCheck {
    double own = 0, own_se = 0;  ///< by the strategy's shared variance
    double shared = 0, shared_se = 0;
    double shared_dof = 1;    ///< of shared_se
    bool is_testable = true;  ///< own_se is known well enough
};

/// All that was measured of one strategy on one scene.
struct StrategyMeasurements {
    Strategy strategy;
    bool was_run = true;
    /// Samples whose mean is one observation: 1, or those of a scrambling. Variances are of one
    /// sample: the observations' times this (docs/theory.md (70)); participations and the moments
    /// of probes are of observations.
    int samples_per_observation = 1;
    Reason not_run_reason;         ///< where !was_run
    double estimated_seconds = 0;  ///< CPU time that it would take, where !was_run

    std::vector<ReplicateValues> replicates;
    /// [replicate][region]: mean over the region's shading points. At most 64 regions that cover
    /// the image (a scene without a camera: one per probe); the same for every strategy; may be
    /// empty.
    std::vector<std::vector<double>> region_means;
    /// [replicate][region]: what the region adds to the replicate's variance; sums to it.
    std::vector<std::vector<double>> region_variances;
    std::vector<Participation> region_participation;  ///< [region]; as many as regions
    PooledFigures pooled;
    /// A theorem says that every sample is the answer (engine/exact.h), or nothing is lit.
    bool is_proved_exact = false;
    /// Zero variance: every sample equals the reference to rounding, by exactness_of().
    bool all_samples_equal_reference = false;
    Audit audit;
    std::optional<SharedFigures> shared;  ///< where its variance comes from shared directions
    /// The image, then its regions; empty where no directions are shared.
    std::vector<MeanCheck> mean_checks;

    std::vector<TimeObservation> times;
    std::map<std::string, double> stage_seconds;  ///< CPU seconds over all samples
    std::uint64_t rays = 0;                       ///< over all samples
    std::uint64_t invalid_samples = 0;
    SampleName first_invalid;     ///< where there are any
    std::vector<Moments> probes;  ///< [probe], merged over all replicates
};

struct SceneMeasurements {
    std::size_t points = 0;  ///< shading points that samples are drawn at; dark ones cost nothing
    std::vector<StrategyMeasurements> strategies;
};

}  // namespace mis
