#pragma once

#include "mis/effects/effects.h"
#include "mis/scene/point_counts.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mis {

/// The smallest and the largest of some numbers.
struct Range {
    double low = 0, high = 0;
};

/// What a material is, and how much of the picture shows it.
struct MaterialUse {
    std::string name, type;
    std::size_t shading_points = 0;
};

/// What a scene is made of and what it calls for: plain data, found without a sample.
struct Explanation {
    std::string file, name;
    std::size_t lights = 0, black_lights = 0;
    Range radius;  ///< of the lights, scene units
    Range power;   ///< luminous, W: Y(L)·4π²r²
    std::size_t quads = 0, spheres = 0, meshes = 0, triangles = 0;
    int width = 0, height = 0;  ///< 0 without a camera
    std::size_t shading_points = 0, dark_points = 0, background_pixels = 0, tiles = 0;
    PointCounts counts;  ///< why points are dark, and whose normals were turned off their surface
    std::size_t probes = 0;
    std::vector<MaterialUse> materials;
    std::vector<EffectPlan> effects;
    std::size_t light_bytes = 0, hierarchy_bytes = 0;
};

}  // namespace mis
