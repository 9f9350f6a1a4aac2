#include "mis/stats/pool.h"

#include "mis/math/stable.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace mis {
namespace {

/// Adds the samples of `point`, each d² times `weight`.
void add(Participation& sum, const Moments& point, double weight)
{
    sum.sum_d2 += weight * point.m2;
    sum.sum_d4 += weight * weight * point.m4;
}

}  // namespace

PooledFigures pool_points(std::span<const Moments> points, std::span<const double> scale)
{
    assert(points.size() == scale.size());
    PooledFigures pooled;
    double rare = 0, largest = 0;
    std::size_t with_variance = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Moments& point = points[i];
        pooled.samples += point.count;
        pooled.mean += point.mean;
        if (point.count < 2) {
            ++pooled.single_points;
            continue;
        }
        ++with_variance;
        const double per_sample = 1 / static_cast<double>(point.count - 1),
                     variance = point.m2 * per_sample;
        pooled.variance += variance;
        add(pooled.participation, point, per_sample);
        largest = std::max(largest, variance);
        if (point.effective_count() < few_samples) rare += variance;
        if (point.mean == 0 && point.m2 == 0) ++pooled.zero_points;
        else
            pooled.largest_relative_variance =
                std::max(pooled.largest_relative_variance,
                         variance == 0 ? 0 : variance * inverse(point.mean * point.mean));
        if (scale[i] > 0) {
            pooled.relative_variance += variance / scale[i];
            add(pooled.relative_participation, point, per_sample / scale[i]);
        } else if (variance > 0) {
            pooled.relative_variance = std::numeric_limits<double>::infinity();
        }
    }
    if (pooled.variance > 0) {
        pooled.rare_share = rare / pooled.variance;
        pooled.largest_point_share = largest / pooled.variance;
    }
    if (!points.empty()) pooled.mean /= static_cast<double>(points.size());
    if (with_variance > 0) {
        pooled.variance /= static_cast<double>(with_variance);
        pooled.relative_variance /= static_cast<double>(with_variance);
    }
    return pooled;
}

RelativeScale relative_scale(std::vector<double> means, const FigurePoints& points)
{
    const auto end_of_figures = means.begin() + static_cast<std::ptrdiff_t>(points.lit);
    RelativeScale scale;
    if (points.has_camera && points.all > 0)
        scale.epsilon = share_of_epsilon * std::accumulate(means.begin(), end_of_figures, 0.0) /
                        static_cast<double>(points.all);
    for (const double mean : means)
        scale.squares.push_back(mean * mean + scale.epsilon * scale.epsilon);
    scale.means = std::move(means);
    return scale;
}

double relative_variance_doubt(std::span<const Moments> points, const RelativeScale& scale)
{
    if (scale.mean_errors.empty()) return 0;
    double by_covariance = 0, by_curvature = 0;
    std::size_t with_variance = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Moments& point = points[i];
        if (point.count < 2) continue;
        ++with_variance;
        const double square = scale.squares[i], mean = scale.means[i];
        if (!(square > 0)) continue;
        const auto n = static_cast<double>(point.count);
        const double slope = -2 * mean / square / square,
                     curvature = (8 * mean * mean / square - 2) / square / square;
        by_covariance += slope * (point.m3 / n) / n;
        by_curvature +=
            0.5 * curvature * point.variance() * scale.mean_errors[i] * scale.mean_errors[i];
    }
    if (with_variance == 0) return 0;
    return (std::abs(by_covariance) + std::abs(by_curvature)) / static_cast<double>(with_variance);
}

Participation participation_of(std::span<const Moments> points)
{
    Participation sum;
    for (const Moments& point : points)
        if (point.count >= 2) add(sum, point, 1 / static_cast<double>(point.count - 1));
    return sum;
}

}  // namespace mis
