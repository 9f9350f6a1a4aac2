#pragma once

#include "mis/math/stop_token.h"
#include "mis/run/executor.h"
#include "mis/scene/scene.h"
#include "mis/strategy/strategy.h"

#include <span>
#include <stdexcept>
#include <vector>

namespace mis {

/// What infinitely many samples of one strategy at one probe would say: of the luminance of one
/// sample. Each figure has a bound of its error. Where a figure leaves the range of a double, it
/// and its error are infinite.
struct Predicted {
    double mean = 0, mean_error = 0;          ///< W·sr⁻¹·m⁻²
    double variance = 0, variance_error = 0;  ///< luminance²
    double fourth = 0, fourth_error = 0;      ///< fourth central moment, luminance⁴
};

/// How far to go: relative errors to aim at, of means and variances; ten times that for fourth
/// moments.
struct PredictTolerance {
    double smooth = 1e-7;
    double jumps = 1e-6;  ///< of strategies whose weights jump (`cutoff`, `maximum`)
};

/// A scene that quadrature cannot answer for. what() says why and what to do.
struct PredictError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// How a prediction runs: on one thread and to its end, unless told otherwise.
struct PredictRun {
    const AnyExecutor* executor = nullptr;  ///< shares the work; no figure depends on it
    StopToken stop = {};                    ///< ends it, with Stopped
};

/// Exact mean, variance and fourth central moment of one sample of each strategy at a probe, by
/// deterministic quadrature in double: no random numbers. Lights hide one another, the horizon cuts
/// them, spheres among the surfaces occlude. The strategies are checked (strategy/strategy.h).
/// Errors: PredictError where a mesh or quad could hide a light from the probe;
/// Stopped. Accuracy: the stated errors bound the true ones (predict_test.cpp);
/// docs/theory-predict.md.
std::vector<Predicted> predict(const Scene& scene, const Probe& probe,
                               std::span<const Strategy> strategies,
                               const PredictTolerance& tolerance = {}, const PredictRun& run = {});

}  // namespace mis
