#pragma once

#include "mis/words/scene_view.h"

namespace mis {

/// Which strategies are exact; which are tied with one another in variance, within `margin`; and
/// which pairs are undecided.
void say_comparisons(Sentences& sentences, const SceneView& view, double margin);

}  // namespace mis
