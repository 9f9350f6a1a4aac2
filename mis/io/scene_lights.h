#pragma once

#include "mis/io/json_node.h"
#include "mis/math/stop_token.h"
#include "mis/scene/light.h"

namespace mis {

/// Appends what one entry of a scene's "lights" stands for: one light, those of a table, or random
/// ones. Throws SceneError and Stopped.
void append_lights(const JsonNode& entry, Lights& to, const StopToken& stop = {});

}  // namespace mis
