#pragma once

#include "mis/scene/scene.h"

#include <cstddef>

namespace mis::cli {

/// Throws UsageError where the samples of so many strategies at every point of the scene would not
/// fit into memory, with their maps if those are wanted.
void check_memory(const Scene& scene, std::size_t strategies, bool with_maps = false);

}  // namespace mis::cli
