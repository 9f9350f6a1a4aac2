#pragma once

#include "mis/scene/scene.h"

#include <string>

namespace mis {

/// A scene as a file that reads back to the same bits: probes, materials, spheres, quads and
/// lights. Names are plain. Throws std::invalid_argument for a camera or a mesh.
std::string scene_text(const Scene& scene);

}  // namespace mis
