#pragma once

#include "mis/cost/curve.h"
#include "mis/stats/pool.h"
#include "mis/study/pilot.h"

#include <optional>
#include <vector>

namespace mis {

/// What the errors of a scene are measured against: the mean of every figure point.
struct CostReference {
    std::vector<double> means;  ///< luminance, [point]
    RelativeScale scale;        ///< what squared errors are divided by
    ReferenceError error;
    ReferenceReport report;
};

/// How far to go for a pooled one: until its error is `error`, or `seconds` of wall time; or, where
/// `samples` is not 0, so many samples per point.
struct ReferenceLimit {
    double error = 2e-4, seconds = 10;
    std::uint64_t samples = 0;
};

/// The lights that quadrature is asked about; beyond, it takes longer than samples do.
inline constexpr std::size_t most_lights_for_quadrature = 64;

/// By quadrature (predict.h): of a scene without a camera whose probes' lights no mesh or quad can
/// hide. Nothing where that cannot answer. Throws Stopped,
/// as all here do.
std::optional<CostReference> exact_reference(const StudyGround& ground);

/// Draws per sample: what a sample costs, the same on every machine.
double draws_of(const Strategy& strategy, std::size_t lights);

/// From samples of up to four strategies that fail in different places, each weighed by its samples
/// over its relative variance: most are of the best, the others check it. Of those that look at
/// every light, none where there are too many. Their random numbers serve nothing else. How far
/// they differ beyond their noise counts as the reference's error.
CostReference pooled_reference(const StudyGround& ground, const ReferenceLimit& limit);

}  // namespace mis
