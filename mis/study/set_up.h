#pragma once

#include "mis/study/affordable.h"
#include "mis/study/rounds.h"
#include "mis/study/shared_turns.h"
#include "mis/study/study_audit.h"
#include "mis/study/study_time.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace mis {

/// What a study has found out and made ready before its first samples.
struct SetUp {
    std::vector<CostEstimate> costs;                 ///< [strategy]
    std::vector<std::unique_ptr<StrategyRun>> runs;  ///< [strategy]; null where it is not run
    RoundOptions how;                                ///< of its rounds
    int first_samples = 0;                           ///< of every point, that had to be affordable
    bool spreads = false;                            ///< samples over tiles, by their variances
    std::unique_ptr<SharedTurns> shared;             ///< null where own samples tell all
    std::vector<Strategy> sharing;                   ///< in the order of `shared`
    std::optional<StudyAudit> audit;                 ///< of own samples
    int replicates = most_replicates;                ///< SamplePlan::replicates, without counts
    int parts = 1;                                   ///< SamplePlan::parts
};

/// What is asked of it.
struct SetUpOptions {
    NumberSource numbers;
    bool shares_samples = true;  ///< where that has a meaning, and there is time
    int threads = 1;             ///< that find work
};

/// What a first look at the costs allows; a rough picture of the scene, for the weights; and either
/// directions that all strategies share, or how own samples are best spread, and the audit. What
/// was not ready when its share of the time was over is not there.
SetUp set_up(const StudyGround& ground, std::span<const Strategy> strategies, const StudyTime& time,
             const SetUpOptions& options);

/// The strategies that run, in their order.
std::vector<Strategy> that_run(std::span<const Strategy> strategies, const SetUp& set_up);

/// Why it is not run. samples: as SetUp::first_samples, with those of an observation.
Reason why_not_run(const CostEstimate& cost, int samples, bool is_stopped);

}  // namespace mis
