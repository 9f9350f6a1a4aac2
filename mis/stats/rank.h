#pragma once

#include "mis/report/report.h"
#include "mis/stats/decision.h"
#include "mis/stats/measurements.h"

#include <span>
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
    /// The part of all these errors that this look may spend. Of several looks at growing
    /// measurements, at each of which it may be decided to stop, the parts sum to at most 1, so
    /// that all looks together keep to the errors.
    double share = 1;
    /// What the look before found, if its verdicts stand, though later looks may spend less.
    const SceneReport* earlier = nullptr;
};

/// What follows from the measurements of one scene.
struct Ranking {
    std::vector<StrategyReport> strategies;  ///< in the order of the measurements
    std::vector<PairReport> pairs;           ///< of the ranked strategies, the better one first
    Decision decision;                       ///< by time to 1 %; without times by variance
    Decision of_one_light;                   ///< the same of those that draw one light, or none
    bool settled = false;                    ///< decided, and every ranked variance is known
    int replicates = 0;                      ///< that all strategies that were run have
};

/// A variance that is known to ± this share is known: design §1.
inline constexpr double variance_is_known = 0.25;

/// Ranks the strategies of one scene: pure arithmetic, the same for the same measurements.
/// Each gets one state, tested in this order (design §1): not_run; not_resolved (resolved.h);
/// biased (bias.h); ranked. The ranked are compared pair by pair over the same replicates
/// (pairs.h): by variance, by efficiency, by time to 1 % error; and with the best (decision.h).
/// Nothing is settled while no strategy is ranked.
Ranking rank(const SceneMeasurements& scene, const RankOptions& options);

/// Puts what was found into a scene's report. seconds: wall, that the measurements took.
void put_ranking(Ranking ranking, double seconds, SceneReport& scene);

}  // namespace mis
