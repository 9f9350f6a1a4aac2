#pragma once

#include "mis/scene/camera.h"
#include "mis/scene/light.h"
#include "mis/scene/material.h"
#include "mis/scene/surface.h"

#include <optional>
#include <string>
#include <vector>

namespace mis {

/// A bare shading point of the file. `normal` and `outgoing` are unit vectors.
struct Probe {
    Vec3<double> position;
    Vec3<double> normal;
    Vec3<double> outgoing;
    int material = 0;
};

/// What there is: plain data, valid once built (scene/validate.h).
struct Scene {
    std::string file;  ///< as the user named it; empty for a scene made in code
    std::string name;
    std::optional<Camera> camera;
    std::vector<Probe> probes;
    std::vector<Material> materials;
    std::vector<Surface> surfaces;
    Lights lights;
};

}  // namespace mis
