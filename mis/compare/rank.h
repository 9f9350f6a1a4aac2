#pragma once

#include "mis/compare/measurements.h"
#include "mis/compare/report.h"

#include <vector>

namespace mis {

struct RankOptions {
    int threads = 1;  ///< that the wall time to 1 % is for
    double at =
        16;  ///< samples per point that a point's preparation is shared by, in the efficiency
    double margin = 0.02;  ///< of a tie
    double family_error =
        0.05;  ///< probability that any `apart` of one kind is wrong; and that any `tied` is
    double bias_error = 1e-3;  ///< probability that any unbiased strategy is called biased
    /// 0: the only look at these measurements. k ≥ 1: the k-th look, at which it may be decided to
    /// stop; it spends 1/(k(k+1)) of both errors, so that all looks together keep to them.
    int look = 0;
};

/// What follows from the measurements of one scene.
struct Ranking {
    std::vector<StrategyReport> strategies;  ///< in the order of the measurements
    std::vector<PairReport> pairs;           ///< of the ranked strategies, the better one first
    bool settled =
        false;  ///< design §1: every pair is apart or tied by variance, or one of it is excluded
    int replicates = 0;  ///< that all strategies that were run have
};

/// Ranks the strategies of one scene: pure arithmetic, the same for the same measurements.
/// Each gets one state, tested in this order (design §1): not_run; not_resolved (resolved.h);
/// biased (bias.h); ranked. The ranked are compared pair by pair over the same replicates
/// (pairs.h): by variance, by efficiency, by time to 1 % error. Nothing is settled while no
/// strategy is ranked.
Ranking rank(const SceneMeasurements& scene, const RankOptions& options);

}  // namespace mis
