#pragma once

#include "mis/engine/lit_scene.h"
#include "mis/report/explanation.h"

namespace mis {

/// Finds out what a scene is made of and what it calls for.
Explanation explain(const LitScene& lit, const AnyExecutor& executor, const StopToken& stop = {});

}  // namespace mis
