#pragma once

#include "mis/report/interval.h"
#include "mis/report/reason.h"
#include "mis/sampling/sample_name.h"
#include "mis/strategy/strategy.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mis {

/// design §1, Figures: a strategy is in one state, tested in this order.
enum class Status { not_run, not_resolved, biased, ranked };

/// As it stands in files.
constexpr const char* name_of(Status status)
{
    constexpr std::array names{"not_run", "not_resolved", "biased", "ranked"};
    return names[static_cast<std::size_t>(status)];
}

/// One shading point's (a probe's) figures.
struct PointFigures {
    double mean = 0, mean_se = 0;  ///< luminance
    Interval variance;             ///< of one sample, luminance²
};

/// How many times what a strategy's own samples show its variances are, at least
/// (stats/resolved.h).
struct AuditedGrowth {
    double variance = 1, relative_variance = 1;
};

/// All that was found about one strategy on one scene.
struct StrategyReport {
    Strategy strategy;
    Status status = Status::not_run;
    Reason reason;                              ///< for every status but ranked
    bool exact = false;                         ///< zero variance, proved
    int rank = 0, rank_low = 0, rank_high = 0;  ///< by variance; 0 where not ranked
    int rank_by_efficiency = 0, rank_by_efficiency_low = 0, rank_by_efficiency_high = 0;
    std::vector<std::string> tied_with;           ///< names, by variance
    std::uint64_t samples = 0;                    ///< over all shading points
    double mean = 0, mean_se = 0;                 ///< luminance, over the shading points
    Interval variance;                            ///< of one sample (docs/theory.md (70) where
                                                  ///< is_sobol); mean over the shading points
    Interval relative_variance;                   ///< design §1
    int timed_rounds = 0;                         ///< that the times come from
    Interval seconds_per_point;                   ///< CPU time to prepare one shading point
    Interval seconds_per_sample;                  ///< CPU time
    std::map<std::string, double> stage_seconds;  ///< per sample
    double rays_per_sample = 0;
    Interval efficiency;            ///< 1/(luminance²·s); infinite where exact
    Interval seconds_to_1_percent;  ///< wall time on the stated threads
    double estimated_seconds = 0;   ///< CPU time that it would take: for not_run
    double bias_p_value = 1;        ///< against the reference pooled from the others, corrected
    double rare_share = 0;          ///< share of the variance at points where rare samples carry it
                                    ///< (stats/pool.h)
    double resolving_factor =
        1;  ///< about how many times as many samples would resolve it; 1 where it is
    AuditedGrowth least_growth;
    double effective_samples =
        0;  ///< how many samples carry the variance (stats/measurements.h, Participation)
    std::uint64_t invalid_samples = 0;
    SampleName first_invalid;  ///< where there are any
    std::vector<PointFigures> probes;
};

/// How two strategies stand: a's figure over b's. The verdicts of one kind hold for all pairs
/// together (95 %), the intervals for each pair alone.
enum class Verdict { apart, tied, undecided };

/// As it stands in files.
constexpr const char* name_of(Verdict verdict)
{
    constexpr std::array names{"apart", "tied", "undecided"};
    return names[static_cast<std::size_t>(verdict)];
}

struct PairReport {
    int a = 0, b = 0;  ///< indices into SceneReport::strategies; a has the lower variance
    Interval ratio;    ///< of the variances; 0 where a alone is exact
    Verdict verdict = Verdict::undecided;
    double more_replicates = 0;  ///< about how many more would decide it; for undecided
    Interval efficiency_ratio;   ///< of the efficiencies; infinite where a alone is exact
    Verdict efficiency_verdict = Verdict::undecided;
    Interval time_ratio;  ///< of the times to 1 %: how many times sooner b reaches it
    Verdict time_verdict = Verdict::undecided;
};

}  // namespace mis
