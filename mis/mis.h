#pragma once

// The core in one include: direct lighting at a point (engine/direct.h), at many points of a host
// (engine/light_points.h), or of a whole picture (engine/render.h), with every policy, technique,
// heuristic and BSDF. No files, no threads, no statistics. docs/embedding.md is a walk-through.

#include "mis/bsdf/framed.h"
#include "mis/bsdf/registry.h"
#include "mis/engine/direct.h"
#include "mis/engine/light_points.h"
#include "mis/engine/render.h"
#include "mis/heuristic/registry.h"
#include "mis/policy/registry.h"
#include "mis/run/serial.h"
#include "mis/scene/validate.h"
#include "mis/strategy/strategy.h"
#include "mis/technique/registry.h"

/// Direct lighting from many spheres, and which of them to draw. What is public, and for how long,
/// stands at the end of docs/embedding.md.
namespace mis {
}
