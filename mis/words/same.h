#pragma once

#include "mis/words/scene_view.h"

#include <vector>

namespace mis {

/// Which ranked strategies are one and the same on a scene: by construction, where there is one
/// light and they differ by how they choose it; or by their samples, which are equal to the last
/// bit.
class SameStrategies {
public:
    explicit SameStrategies(const SceneView& view);

    /// The first, in the order asked for, of those that are the same as i; i itself if none is.
    int first_of(int i) const { return first_[static_cast<std::size_t>(i)]; }
    bool are_same(int i, int j) const { return first_of(i) == first_of(j); }
    /// Does none before it stand for it?
    bool is_first(int i) const { return first_of(i) == i; }

private:
    std::vector<int> first_;
};

/// Says it once: of policies, which strategies share; then of single strategies.
void say_the_same(Sentences& sentences, const SceneView& view, const SameStrategies& same);

}  // namespace mis
