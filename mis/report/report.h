#pragma once

#include "mis/effects/effects.h"
#include "mis/report/run_head.h"
#include "mis/report/scene_facts.h"
#include "mis/report/strategy_report.h"

#include <string>
#include <vector>

namespace mis {

struct SceneReport : SceneFacts {
    int replicates = 0;
    double epsilon = 0;  ///< of the relative variance
    bool settled = false, partial = false;
    bool lacks_audit = false;  ///< for rare samples that were never drawn
    double seconds = 0;        ///< wall
    std::vector<EffectPlan> effects;
    std::vector<StrategyReport> strategies;  ///< in the order asked for
    std::vector<PairReport> pairs;           ///< of ranked strategies
};

/// One strategy over all scenes (stats/overall.h): geometric means of its figures over the best
/// one's of each scene.
struct OverallReport {
    std::string name;
    int rank = 0, rank_by_efficiency = 0;
    Interval variance_ratio, cost_ratio,
        time_ratio;           ///< ≥ 1; cost: variance × time, 1/efficiency; time: to 1 %
    int beaten_by_exact = 0;  ///< scenes on which others are exact and it is not; there the first
                              ///< two are over the best inexact
};

/// is_sobol: sequences of `at` samples.
struct Report : RunHead {
    double margin = 0.02;
    double at = 16;
    std::vector<SceneReport> scenes;
    std::vector<OverallReport> overall;  ///< by rank; empty unless there are several scenes
};

}  // namespace mis
