#include "mis/study/study_audit.h"

#include "mis/strategy/names.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mis {

namespace {

/// Rounds at each point that count, at least, and so many over all points.
constexpr std::size_t fewest_rounds = 2, fewest_looks = 2048;

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
{
    points_ = spread_points(ground.points, affordable_points(ground, strategies));
    if (points_.empty()) return;
    std::vector<SharedPoint> at;
    for (const std::size_t p : points_) {
        weights_.push_back(weights[p]);
        at.push_back({ground.points.shading.points[p], ground.points.material_of(p)});
    }
    SharedSamples shared(ground.scene, std::move(at), strategies,
                         {.seed = ground.seed, .stop = ground.stop});
    shared.take(1 + static_cast<int>(std::max(fewest_rounds, fewest_looks / points_.size())),
                ground.executor);
    if (!shared.is_even()) return;
    for (std::size_t s = 0; s < strategies.size(); ++s)
        estimates_[name_of(strategies[s])] = {shared.mean(s), shared.mean(s, weights_)};
}

StudyAudit::StudyAudit(const SharedTurns& shared, std::size_t points,
                       std::span<const double> weights, std::span<const Strategy> strategies)
    : points_(points),
      weights_(weights.begin(), weights.begin() + static_cast<std::ptrdiff_t>(points))
{
    std::iota(points_.begin(), points_.end(), std::size_t{0});
    for (std::size_t s = 0; s < strategies.size(); ++s)
        estimates_[name_of(strategies[s])] = {shared.mean(s), shared.mean(s, weights_)};
}

void StudyAudit::add_to(StrategyMeasurements& m, std::span<const PointResult> results) const
{
    const auto found = estimates_.find(name_of(m.strategy));
    if (found == estimates_.end()) return;
    const auto& [variance_there, relative_there] = found->second;
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
    own.variance_from_others = std::max(variance_there.value, 0.0);
    own.variance_from_others_se = variance_there.se;
    own.relative_variance_from_others = std::max(relative_there.value, 0.0);
    own.relative_variance_from_others_se = relative_there.se;
    m.audit = own;
}

}  // namespace mis
