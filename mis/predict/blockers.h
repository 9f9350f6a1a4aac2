#pragma once

#include "mis/math/stop_token.h"
#include "mis/scene/scene.h"

namespace mis {

/// Throws PredictError if a mesh or a quad of the scene could hide a light from the probe. One that
/// provably cannot (it lies below the horizon, beyond the light, or has probe and light on one side
/// of its plane) is let through.
/// Throws Stopped.
void refuse_blockers(const Scene& scene, const Probe& probe, const StopToken& stop = {});

}  // namespace mis
