#pragma once

#include "mis/scene/scene.h"

namespace mis::bench {

/// Where lights stand: near one height, as lamps do; or anywhere in a volume.
enum class Layout { ceiling, cloud };

/// A square with a dozen towers under `count` random lights, made in code. The lights' radii go
/// with 1/√count: whatever their number, they fill the same part of the sky.
Scene random_scene(std::size_t count, Layout layout = Layout::ceiling);

}  // namespace mis::bench
