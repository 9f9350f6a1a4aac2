#pragma once

#include <cstddef>
#include <string>

namespace mis {

/// What a report says of a scene, before anything is sampled.
struct SceneFacts {
    std::string file, name;
    std::size_t lights = 0, surfaces = 0, triangles = 0;
    int width = 0, height = 0;  ///< 0 without a camera
    std::size_t shading_points = 0, background_pixels = 0;
};

}  // namespace mis
