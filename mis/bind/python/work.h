#pragma once

#include "mis/engine/render.h"
#include "mis/math/stop_token.h"
#include "mis/predict/predict.h"
#include "mis/report/report.h"
#include "mis/trace/embree.h"

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

// What the Python module does, without Python: values in, values out, on as many threads as asked.

namespace mis::python {

/// A scene with all that lighting it takes.
struct ReadyScene {
    /// Throws Stopped.
    explicit ReadyScene(Scene s, const StopToken& stop = {});
    ReadyScene(const ReadyScene&) = delete;
    ReadyScene& operator=(const ReadyScene&) = delete;

    Scene scene;
    std::unique_ptr<SurfaceTracer> tracer;  ///< nullptr where there is nothing to trace
    LitScene lit;
};

/// An argument out of its range. what(): its name, what was found, what is allowed.
struct ArgumentError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// How to run. Throws ArgumentError where `threads` is out of range.
struct Run {
    std::uint64_t seed = 1;
    int threads = 0;                          ///< 0: as many as the machine has
    const std::atomic<bool>* stop = nullptr;  ///< set from outside: ends the run, with Stopped

    StopToken token() const { return StopToken(stop); }
};

struct Picture {
    Image image;
    std::vector<double> variance;  ///< per pixel: of one sample's luminance; NaN without a surface
    std::uint64_t invalid = 0;
};
/// `spp` samples of every pixel's shading point. Throws StrategyError, ArgumentError.
Picture render(const ReadyScene& ready, const std::string& strategy, std::int64_t spp,
               const std::string& sampler, const Run& run);

/// A probe by its number, or a pixel by column and row from the top left.
using Place = std::variant<std::int64_t, std::array<std::int64_t, 2>>;

/// Luminances of samples [first, first + count) at one shading point, in order: the samples that
/// `compare` and `render` take with the same sampler. Throws StrategyError, ArgumentError.
std::vector<double> samples(const ReadyScene& ready, const std::string& strategy,
                            const Place& place, std::int64_t count, std::int64_t first,
                            const std::string& sampler, const Run& run);

struct CompareOptions {
    std::optional<std::int64_t> spp;
    std::optional<double> seconds, error;
    double at = 16;
    std::string sampler = "independent";
};
/// As `mis compare` reports it. Throws StrategyError, ArgumentError.
Report compare(const ReadyScene& ready, const std::vector<std::string>& strategies,
               const CompareOptions& options, const Run& run);

/// One entry per probe and strategy, probes first. Throws StrategyError, ArgumentError where there
/// are no probes, and PredictError.
std::vector<Predicted> predict(const ReadyScene& ready, const std::vector<std::string>& strategies,
                               const Run& run);

}  // namespace mis::python
