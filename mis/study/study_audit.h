#pragma once

#include "mis/study/pilot.h"
#include "mis/study/shared_samples.h"
#include "mis/study/shared_turns.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace mis {

/// A strategy's own samples cannot see what they never drew: directions that all strategies share
/// (shared_samples.h) say what its variance is at some of a study's points. Made once, before the
/// sampling, and set beside what its own samples say there.
class StudyAudit {
public:
    /// weights: 1/(μ² + ε²) of every point of the ground. Throws Stopped.
    StudyAudit(const StudyGround& ground, std::span<const double> weights,
               std::span<const Strategy> strategies);

    /// Of directions that are shared at all points of the figures already. Precondition:
    /// shared.is_known().
    StudyAudit(const SharedTurns& shared, std::size_t points, std::span<const double> weights,
               std::span<const Strategy> strategies);

    /// Is there none, as there was no point, or no time?
    bool is_empty() const { return estimates_.empty(); }

    /// results: of the strategy that `m` is of, at every point. Nothing is added where the audit
    /// has nothing to say, or a point that was audited has not been sampled twice.
    void add_to(StrategyMeasurements& m, std::span<const PointResult> results) const;

private:
    std::vector<std::size_t> points_;
    struct Estimate {
        ValueAndError variance, relative_variance;
    };
    std::vector<double> weights_;                ///< of these points
    std::map<std::string, Estimate> estimates_;  ///< by the strategy's name; none if it was stopped
};

}  // namespace mis
