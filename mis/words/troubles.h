#pragma once

#include "mis/words/scene_view.h"

namespace mis {

/// What keeps strategies from being ranked, or their figures from being trusted.
void say_troubles(Sentences& sentences, const SceneView& view);

}  // namespace mis
