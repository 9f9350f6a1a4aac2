#pragma once

#include "mis/stats/measurements.h"

#include <span>

namespace mis {

/// A point's variance is rare samples' when fewer than so many carry it: ten is where its standard
/// error is a third.
inline constexpr double few_samples = 10;

/// One strategy's figures over an image, from the moments of each of its shading points.
/// scale: μ² + ε² of each point, which `relative_variance` divides by; the same numbers for every
/// strategy (so μ is a reference pooled from those that are resolved, not the strategy's own noisy
/// mean). Where it is 0 and the variance is not, `relative_variance` is infinite: it has no value
/// there. Preconditions: as many scales as points; points with fewer than two samples are left out
/// of the variances.
PooledFigures pool_points(std::span<const Moments> points, std::span<const double> scale);

/// The points that a scene's figures are over: those that can be lit come first among all points.
struct FigurePoints {
    std::size_t lit = 0, all = 0;
    bool has_camera = false;  ///< else they are probes
};

/// ε over the image's mean (design §1).
inline constexpr double share_of_epsilon = 0.01;

/// What relative variances divide by: μ² + ε² of every point, and ε, which is 1 % of the mean over
/// the figures' points, or 0 without a camera (design §1).
struct RelativeScale {
    double epsilon = 0;
    std::vector<double> squares;      ///< μ² + ε²
    std::vector<double> means;        ///< μ
    std::vector<double> mean_errors;  ///< standard errors of μ, at most; empty: it is exact
};
RelativeScale relative_scale(std::vector<double> means, const FigurePoints& points);

/// How far off `relative_variance` may be in the mean, to first order, because μ is estimated from
/// samples that it is correlated with: docs/theory.md, eq. 73. Of the same points as pool_points().
double relative_variance_doubt(std::span<const Moments> points, const RelativeScale& scale);

/// How many samples carry the variance over these points.
Participation participation_of(std::span<const Moments> points);

}  // namespace mis
