#pragma once

#include "mis/engine/lit_scene.h"
#include "mis/math/stop_token.h"

#include <vector>

namespace mis {

/// What a batch of one sample holds after one of its stages.
struct ReplayStep {
    bool is_light_half;
    std::uint32_t draw;  ///< number of the draw within its half
    StageKind stage;
    bool is_alive;               ///< a row is left: the draw may still contribute
    LightIndex light;            ///< no_light until one is chosen or met
    double u, v, lobe;           ///< random numbers of the draw, in [0, 1)
    double probability;          ///< of the light
    Vec3<double> wi;             ///< scene axes
    double distance;             ///< to the light
    double light_pdf, bsdf_pdf;  ///< per steradian
    Vec3<double> contribution;   ///< f cos θ until it is weighed, then the share of the estimate
};

struct Replay {
    std::vector<ReplayStep> steps;
    Vec3<double> value;  ///< the sample's radiance
};

/// One sample again, stage by stage: the same numbers, the same arithmetic, every intermediate
/// result. What no stage of the half has filled yet is 0; a half ends where nothing is left of it.
/// Throws Stopped.
template <class T>
Replay replay(const LitScene& scene, const ReadyStrategy<T>& strategy, const Tile& tile,
              const ShadingPoint& point, std::uint64_t sample, const StopToken& stop = {});

}  // namespace mis
