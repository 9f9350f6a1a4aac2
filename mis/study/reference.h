#pragma once

#include "mis/stats/pool.h"
#include "mis/study/strategy_run.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace mis {

/// μ of every point: the means of some strategies, by weights that sum to 1.
struct PooledMeans {
    std::vector<double> weights;  ///< [strategy]: its samples over its variance; 0: not trusted
    std::vector<double> values;
    std::vector<double> errors;  ///< standard errors of the values, were all strategies one
};

/// Pools the means of those that are trusted. One that never drew what is rare has hardly a
/// variance, and would outvote all others. runs: null where a strategy was not run.
/// known: [strategy] its variance, where that is known apart from its samples.
PooledMeans pooled_means(std::span<const std::unique_ptr<StrategyRun>> runs,
                         const std::vector<bool>& trusted, std::size_t points,
                         std::span<const std::optional<double>> known = {});

/// What the strategies of a study are measured against, and whose means make it.
class StudyReference {
public:
    /// What strategy s came to by that scale.
    using Measure = std::function<StrategyMeasurements(std::size_t s, const RelativeScale& scale)>;

    /// Its variance, mean over the points, where shared directions say it.
    using KnownVariance = std::function<std::optional<double>(std::size_t s)>;

    /// runs: of all strategies; null where one was not run.
    StudyReference(std::span<const std::unique_ptr<StrategyRun>> runs, const StudyPoints& points,
                   Measure measure, KnownVariance known);

    /// All strategies by one reference, of the means of those that are resolved: first by what
    /// takes no reference, then by the relative variance, too.
    SceneMeasurements of_resolved();

    /// Trusts only those of the trusted that pass, if any does. Are they fewer?
    bool trust_fewer(const std::function<bool(std::size_t s)>& passes);

    /// All strategies, against the means of those that are trusted now.
    SceneMeasurements of_trusted();

    /// As of the last measurement.
    const std::vector<double>& weights() const { return weights_; }
    double epsilon() const { return epsilon_; }

private:
    std::span<const std::unique_ptr<StrategyRun>> runs_;
    const StudyPoints& points_;
    Measure measure_;
    KnownVariance known_;
    std::vector<bool> trusted_;  ///< [strategy]
    std::vector<double> weights_;
    double epsilon_ = 0;
};

}  // namespace mis
