#pragma once

#include "mis/math/stop_token.h"
#include "mis/scene/light.h"

#include <array>
#include <cstdint>

namespace mis {

/// What an entry of type "random" asks for. Ranges are [low, high].
struct RandomLights {
    std::size_t count = 0;
    std::uint64_t seed = 0;
    std::array<Vec3<double>, 2> box{};  ///< of the centres: lowest and highest corner
    std::array<double, 2> radius{};     ///< > 0
    std::array<double, 2> power{};      ///< > 0, watts
};

/// Appends `lights.count` grey lights: position uniform in the box, radius and power log-uniform,
/// all independent. Reproducible to the last bit on every machine: docs/scene-format.md, "Random
/// lights", states the generator. Throws Stopped.
void append_random_lights(const RandomLights& lights, Lights& to, const StopToken& stop = {});

}  // namespace mis
