#pragma once

#include "mis/study/audit.h"
#include "mis/study/pilot.h"

#include <map>
#include <span>
#include <string>
#include <vector>

namespace mis {

/// The audit of a study's strategies at some of its points, made once before the sampling, and set
/// beside what their own samples say there.
class StudyAudit {
public:
    /// weights: 1/(μ² + ε²) of every point of the ground.
    StudyAudit(const StudyGround& ground, std::span<const double> weights,
               std::span<const Strategy> strategies);

    /// results: of the strategy that `m` is of, at every point. Nothing is added where the audit
    /// has nothing to say, or a point that was audited has not been sampled twice.
    void add_to(StrategyMeasurements& m, std::span<const PointResult> results) const;

private:
    std::vector<std::size_t> points_;
    std::vector<double> weights_;                     ///< of these points
    std::map<std::string, AuditEstimate> estimates_;  ///< by the strategy's name
};

}  // namespace mis
