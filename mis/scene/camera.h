#pragma once

#include "mis/math/vec.h"

#include <array>

namespace mis {

/// A pinhole camera; one shading point per pixel, through the pixel's centre.
struct Camera {
    Vec3<double> position{0};
    Vec3<double> target{0, 0, -1};
    Vec3<double> up{0, 1, 0};
    double vertical_fov_degrees = 45;
    std::array<int, 2> resolution{256, 256};  ///< width, height
};

}  // namespace mis
