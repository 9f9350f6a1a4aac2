#pragma once

#include "mis/words/same.h"

namespace mis {

/// Which strategies are exact; which are tied with one another in variance, within `margin`; and
/// which pairs are undecided.
/// Of strategies that are the same, the first speaks for all.
void say_comparisons(Sentences& sentences, const SceneView& view, const SameStrategies& same,
                     double margin);

}  // namespace mis
