#include "mis/cost/scene_report.h"

#include "mis/cost/crossings.h"

#include <cmath>

namespace mis {
namespace {

/// Number types are compared of one strategy, strategies in one number type.
bool are_compared(const CostMeasurements& a, const CostMeasurements& b)
{
    return a.precision == b.precision || a.strategy == b.strategy;
}

CostReason why_no_points(const CostGround& ground)
{
    if (ground.points == 0) return reason::NothingLit{};
    return reason::Stopped{};
}

}  // namespace

CostSceneReport report_of(std::span<const CurveRun> curves, const CostGround& ground, bool is_sobol)
{
    CostSceneReport report;
    std::vector<CostModel> models;
    for (const CurveRun& curve : curves) {
        report.curves.push_back(curve_report(curve.measured, ground));
        CostCurveReport& last = report.curves.back();
        if (is_none(last.reason) && last.points.empty()) last.reason = why_no_points(ground);
        models.push_back(model_of(curve.measured, ground));
        // Sequences have no error² = V/n to go by.
        if (!last.fits || is_sobol) models.back().log_variance.value = std::nan("");
    }
    report.crossings = find_crossings(models);
    std::erase_if(report.crossings, [&](const CrossingReport& crossing) {
        return !are_compared(curves[static_cast<std::size_t>(crossing.before)].measured,
                             curves[static_cast<std::size_t>(crossing.after)].measured);
    });
    return report;
}

}  // namespace mis
