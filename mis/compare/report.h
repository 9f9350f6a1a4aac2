#pragma once

#include "mis/effects/effects.h"
#include "mis/engine/sample_name.h"
#include "mis/strategy/strategy.h"

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mis {

/// A figure and its 95 % interval. low and high are NaN where no interval is known; all three where
/// there is no figure.
struct Interval {
    double value = 0, low = 0, high = 0;
};

/// design §1, Figures: a strategy is in one state, tested in this order.
enum class Status { not_run, not_resolved, biased, ranked };

/// One shading point's (a probe's) figures.
struct PointFigures {
    double mean = 0, mean_se = 0;  ///< luminance
    Interval variance;             ///< of one sample, luminance²
};

/// How many times what a strategy's own samples show its variances are, at least (resolved.h).
struct AuditedGrowth {
    double variance = 1, relative_variance = 1;
};

/// All that was found about one strategy on one scene.
struct StrategyReport {
    Strategy strategy;
    Status status = Status::not_run;
    std::string reason;                         ///< in words, for every status but ranked
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
    double rare_share = 0;          ///< share of the variance at points where rare samples
                                    ///< carry it (pool.cpp)
    double resolving_factor = 1;    ///< about how many times as many samples would
                                    ///< resolve it; 1 where it is
    AuditedGrowth least_growth;
    double effective_samples = 0;  ///< how many samples carry the variance
                                   ///< (measurements.h, Participation)
    std::uint64_t invalid_samples = 0;
    SampleName first_invalid;  ///< where there are any
    std::vector<PointFigures> probes;
};

/// How two strategies stand: a's figure over b's. The verdicts of one kind hold for all pairs
/// together (95 %), the intervals for each pair alone.
enum class Verdict { apart, tied, undecided };
struct PairReport {
    int a = 0, b = 0;  ///< indices into SceneReport::strategies; a has the lower variance
    Interval ratio;    ///< of the variances; 0 where a alone is exact
    Verdict verdict = Verdict::undecided;
    double more_replicates = 0;  ///< about how many more would decide it; for undecided
    Interval efficiency_ratio;   ///< of the efficiencies; infinite where a alone is
                                 ///< exact
    Verdict efficiency_verdict = Verdict::undecided;
    Interval time_ratio;  ///< of the times to 1 %: how many times sooner b reaches it
    Verdict time_verdict = Verdict::undecided;
};

/// Wall time before a study begins, which is no part of its `seconds`.
struct SetupSeconds {
    double reading = 0;   ///< the scene's files
    double surfaces = 0;  ///< Embree's tree
    double lights = 0;    ///< the hierarchy that rays ask for lights

    double all() const { return reading + surfaces + lights; }
};

struct SceneReport {
    std::string file, name;
    std::size_t lights = 0, surfaces = 0, triangles = 0;
    int width = 0, height = 0;  ///< 0 without a camera
    std::size_t shading_points = 0, background_pixels = 0;
    int replicates = 0;
    double epsilon = 0;  ///< of the relative variance
    bool settled = false, partial = false;
    bool lacks_audit = false;            ///< for rare samples that were never drawn
    bool had_no_time_for_audit = false;  ///< that is why; else that its samples are sequences
    double seconds = 0;                  ///< wall
    std::optional<SetupSeconds> setup;   ///< where it was timed
    std::vector<EffectPlan> effects;
    std::vector<StrategyReport> strategies;  ///< in the order asked for
    std::vector<PairReport> pairs;           ///< of ranked strategies
};

/// One strategy over all scenes (overall.h): geometric means of its figures over the best one's of
/// each scene.
struct OverallReport {
    std::string name;
    int rank = 0, rank_by_efficiency = 0;
    Interval variance_ratio, cost_ratio,
        time_ratio;           ///< ≥ 1; cost: variance × time, 1/efficiency; time: to 1 %
    int beaten_by_exact = 0;  ///< scenes on which others are exact and it is not;
                              ///< there the first two are over the best inexact
};

struct Report {
    std::string version, command, machine, instruction_set;
    std::uint64_t seed = 1;
    bool is_sobol = false;  ///< scrambled sequences of `at` samples; else independent samples
    int threads = 1;
    bool partial = false;
    double margin = 0.02;
    double at = 16;
    std::vector<SceneReport> scenes;
    std::vector<OverallReport> overall;  ///< by rank; empty unless there are several scenes
};

}  // namespace mis
