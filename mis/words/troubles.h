#pragma once

#include "mis/words/scene_view.h"

#include <string>
#include <vector>

namespace mis {

/// What keeps strategies from being ranked, or their figures from being trusted.
void say_troubles(Sentences& sentences, const SceneView& view);

/// The same, and how strategies compare, as one sentence for each kind: how many there are of it,
/// and the first of them.
std::vector<std::string> kinds_of_trouble(const SceneReport& scene);

}  // namespace mis
