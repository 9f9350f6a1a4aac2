#include "mis/study/reference.h"

#include "mis/stats/resolved.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mis {
namespace {

/// Samples over the variance of one, in the mean over the points.
double precision(const StrategyRun& run, std::optional<double> known)
{
    double variance = 0, mean = 0;
    for (const PointResult& result : run.results()) {
        if (result.luminance.count > 1) variance += result.luminance.variance();
        mean += std::abs(result.luminance.mean);
    }
    const double n = std::max<double>(1, static_cast<double>(run.results().size()));
    if (known) variance = *known * n;
    const double floor = 1e-12 * (mean / n) * (mean / n) + 1e-300;
    return static_cast<double>(run.samples()) / (variance / n + floor);
}

std::vector<double> pooling_weights(std::span<const std::unique_ptr<StrategyRun>> runs,
                                    const std::vector<bool>& trusted,
                                    std::span<const std::optional<double>> known)
{
    std::vector<double> weights(runs.size());
    double sum = 0;
    for (std::size_t s = 0; s < runs.size(); ++s)
        if (trusted[s] && runs[s] && runs[s]->samples() > 0)
            sum += weights[s] = precision(*runs[s], known.empty() ? std::nullopt : known[s]);
    for (double& weight : weights) weight = sum > 0 ? weight / sum : 0;
    return weights;
}

}  // namespace

PooledMeans pooled_means(std::span<const std::unique_ptr<StrategyRun>> runs,
                         const std::vector<bool>& trusted, std::size_t points,
                         std::span<const std::optional<double>> known)
{
    PooledMeans means{pooling_weights(runs, trusted, known), std::vector<double>(points),
                      std::vector<double>(points)};
    for (std::size_t s = 0; s < runs.size(); ++s) {
        if (!(means.weights[s] > 0)) continue;
        for (std::size_t p = 0; p < points; ++p) {
            const Moments& own = runs[s]->results()[p].luminance;
            means.values[p] += means.weights[s] * own.mean;
            if (own.count > 1) means.errors[p] += means.weights[s] * own.mean_se();
        }
    }
    return means;
}

StudyReference::StudyReference(std::span<const std::unique_ptr<StrategyRun>> runs,
                               const StudyPoints& points, Measure measure, KnownVariance known)
    : runs_(runs), points_(points), measure_(std::move(measure)), known_(std::move(known))
{
}

SceneMeasurements StudyReference::of_resolved()
{
    trusted_.clear();
    for (const auto& run : runs_) trusted_.push_back(run != nullptr);
    SceneMeasurements scene = of_trusted();
    // One whose variance is known apart from its samples outvotes nobody by what it never drew.
    const auto passes = [&](auto why_not) {
        return [this, &scene, why_not](std::size_t s) {
            return known_(s).has_value() || is_none(why_not(scene.strategies[s]));
        };
    };
    const bool some_are_blind = trust_fewer(passes(why_blind));
    if (trust_fewer(passes(why_variance_not_resolved)) || some_are_blind) scene = of_trusted();
    if (trust_fewer(passes(why_not_resolved))) scene = of_trusted();
    return scene;
}

bool StudyReference::trust_fewer(const std::function<bool(std::size_t)>& passes)
{
    std::vector<bool> fewer = trusted_;
    for (std::size_t s = 0; s < fewer.size(); ++s) fewer[s] = trusted_[s] && passes(s);
    const bool is_any_left = std::find(fewer.begin(), fewer.end(), true) != fewer.end();
    if (!is_any_left || fewer == trusted_) return false;
    trusted_ = std::move(fewer);
    return true;
}

SceneMeasurements StudyReference::of_trusted()
{
    std::vector<std::optional<double>> known;
    for (std::size_t s = 0; s < runs_.size(); ++s) known.push_back(known_(s));
    PooledMeans means = pooled_means(runs_, trusted_, points_.shading.points.size(), known);
    weights_ = std::move(means.weights);
    RelativeScale scale = relative_scale(std::move(means.values), points_.figures());
    scale.mean_errors = std::move(means.errors);
    epsilon_ = scale.epsilon;
    SceneMeasurements scene{points_.figure_lit, {}};
    for (std::size_t s = 0; s < runs_.size(); ++s) scene.strategies.push_back(measure_(s, scale));
    return scene;
}

}  // namespace mis
