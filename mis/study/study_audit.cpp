#include "mis/study/study_audit.h"

#include "mis/strategy/names.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace mis {

namespace {

int material_of(const StudyPoints& points, std::size_t point)
{
    const std::vector<Tile>& tiles = points.shading.tiles;
    const auto after =
        std::upper_bound(tiles.begin(), tiles.end(), point,
                         [](std::size_t p, const Tile& tile) { return p < tile.first; });
    return std::prev(after)->material;
}

/// How many points can be audited: the tables of their policies take the time.
std::size_t affordable_points(const StudyGround& ground, std::span<const Strategy> strategies)
{
    std::size_t prepared = 1;
    for (const Strategy& s : strategies)
        prepared += s.chooses_light() && reads_all_lights(s.policy) ? 1 : 0;
    const std::size_t most = 50'000'000 / (prepared * ground.scene.scene().lights.size() + 1) + 4;
    return std::min<std::size_t>(1024, most);
}

}  // namespace

StudyAudit::StudyAudit(const StudyGround& ground, std::span<const double> weights,
                       std::span<const Strategy> strategies)
    : points_(spread_points(ground.points, affordable_points(ground, strategies)))
{
    std::vector<AuditPoint> at;
    for (const std::size_t p : points_) {
        weights_.push_back(weights[p]);
        at.push_back({ground.points.shading.points[p], material_of(ground.points, p), weights[p]});
    }
    const std::vector<AuditEstimate> estimates =
        audit(ground.scene, at, strategies, ground.seed, ground.executor);
    for (std::size_t s = 0; s < strategies.size(); ++s)
        estimates_[name_of(strategies[s])] = estimates[s];
}

void StudyAudit::add_to(StrategyMeasurements& m, std::span<const PointResult> results) const
{
    const auto found = estimates_.find(name_of(m.strategy));
    if (found == estimates_.end() || !found->second.available) return;
    const AuditEstimate& others = found->second;
    const double n = static_cast<double>(points_.size());
    double squares = 0, relative_squares = 0;
    Audit own{.available = true, .relative_available = true};
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const Moments& moments = results[points_[i]].luminance;
        if (moments.count < 2) return;
        const double variance = moments.variance() / n, se = moments.variance_se() / n;
        own.own_variance += variance;
        own.own_relative_variance += variance * weights_[i];
        squares += se * se;
        relative_squares += se * se * weights_[i] * weights_[i];
    }
    own.own_variance_se = std::sqrt(squares);
    own.own_relative_variance_se = std::sqrt(relative_squares);
    own.variance_from_others = others.variance;
    own.variance_from_others_se = others.variance_se;
    own.relative_variance_from_others = others.relative_variance;
    own.relative_variance_from_others_se = others.relative_variance_se;
    m.audit = own;
}

}  // namespace mis
