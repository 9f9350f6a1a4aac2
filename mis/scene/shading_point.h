#pragma once

#include "mis/math/vec.h"

#include <cstdint>

namespace mis {

/// A point that is lit, as an embedder or the G-buffer gives it: 64 bytes.
struct ShadingPoint {
    Vec3<double> x;  ///< scene units
    Vec3<float> n;   ///< unit shading normal
    Vec3<float> wo;  ///< unit direction to the viewer
    Vec3<float>
        ray_origin;  ///< x moved off its own surface; in the tracer's frame (trace/visibility.h)
    std::uint32_t
        id;  ///< its number in random sequences: the pixel's, or after all pixels the probe's
};
static_assert(sizeof(ShadingPoint) == 64);

}  // namespace mis
