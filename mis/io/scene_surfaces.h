#pragma once

#include "mis/io/json_node.h"
#include "mis/math/stop_token.h"
#include "mis/scene/material.h"
#include "mis/scene/surface.h"

#include <vector>

namespace mis {

/// A scene's "materials", in the order of their names. Throws SceneError, as all functions here.
std::vector<Material> read_materials(const JsonNode& materials);

/// The index of the material that a member "material" names.
int read_material_name(const JsonNode& name, const std::vector<Material>& materials);

/// One entry of a scene's "surfaces"; reads the file of a mesh. Throws Stopped, too.
Surface read_surface(const JsonNode& entry, const std::vector<Material>& materials,
                     const StopToken& stop = {});

}  // namespace mis
