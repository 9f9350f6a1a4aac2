#pragma once

#include "mis/report/report.h"
#include "mis/study/shared_turns.h"
#include "mis/study/stopping.h"
#include "mis/study/strategy_run.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>

namespace mis {

struct StudyOptions {
    std::uint64_t seed = 1;
    /// 0: independent samples. n: Sobol' sequences of n samples, each scrambled apart; variances
    /// are over scramblings alone (docs/theory.md (70)), and there is no audit. n divides spp.
    std::uint64_t samples_per_scrambling = 0;
    /// Are the numbers asked for? Else `strata` has those that suit it (NumberSource).
    bool names_sampler = false;
    /// Variances come from every strategy's own samples; else, where numbers are independent and
    /// there is time, from directions that all share (docs/theory.md §25).
    bool own_samples = false;
    double at = 16;  ///< samples per point that the efficiency is for
    /// So many samples per point, for every strategy; and so many shared directions.
    std::optional<std::uint64_t> spp;
    std::optional<double> seconds;  ///< so much wall time
    std::optional<double> error;    ///< until every ranked variance is known to ± this share
    double default_seconds = 30;    ///< without any of these: until settled, or this
    /// Told of the first NaN or infinite sample of a strategy, after each of its rounds, and of the
    /// `at` of that study; it may throw.
    std::function<void(const Strategy& strategy, const SampleName& sample, double at)> on_invalid;
    const std::atomic<bool>* stop = nullptr;  ///< set from outside: end with the results so far
    std::function<void(double done, const SceneReport& so_far)> progress;

    StudyGoal goal() const { return {spp, seconds, error, default_seconds}; }
};

/// A study of one scene: its report, and what every strategy's samples came to at every point.
struct Study {
    SceneReport report;
    std::unique_ptr<StudyPoints> points;
    std::vector<std::unique_ptr<StrategyRun>> runs;  ///< [strategy]; null where it was not run
    std::vector<double> reference_weights;           ///< [strategy]: of its means in the reference
    std::unique_ptr<SharedTurns> shared = nullptr;   ///< null where own samples tell all
    /// [strategy]: its place among those that share directions, where its variance is from these.
    std::vector<std::optional<std::size_t>> shared_places = {};

    /// Is a strategy's variance known apart from its samples?
    bool is_shared(std::size_t s) const { return s < shared_places.size() && shared_places[s]; }
    /// Of one sample at one of the figures' points (docs/theory.md (70)). Unbiased: where little is
    /// known it may be below 0. Precondition: the strategy was run.
    double variance_at(std::size_t s, std::size_t point) const
    {
        return is_shared(s) ? shared->at(*shared_places[s], point).value
                            : runs[s]->variance_at(point);
    }
};

/// Samples the strategies in small alternating rounds and ranks them, until it is time to stop. The
/// time begins here: all that is prepared counts. Throws Stopped where it is over, or *options.stop
/// set, before the shading points are found.
Study run_study(const LitScene& scene, const std::vector<Strategy>& strategies,
                const StudyOptions& options, const AnyExecutor& executor);

/// The memory that a study of so many points and strategies takes, bytes.
std::size_t study_bytes(std::size_t points, std::size_t strategies);

}  // namespace mis
