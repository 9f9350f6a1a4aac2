#pragma once

#include "mis/math/stop_token.h"
#include "mis/scene/light.h"

#include <vector>

namespace mis {

/// Another order of a scene's lights, in which neighbours stand near each other in space. Where a
/// choice's bits run through the lights' probabilities in this order, bits that are spread evenly
/// spread the choices evenly over the scene. The numbers of the lights stay what they are.
struct LightOrder {
    LargeVector<LightIndex> light_at;  ///< [place]
    LargeVector<LightIndex> place_of;  ///< [light]
};

/// By halves: the lights cut in two at the median of their widest extent, and each half likewise,
/// so that a far sun leaves the lamps' order alone. O(M log M). Throws Stopped.
LightOrder spatial_order(const Lights& lights, const StopToken& stop = {});

/// The lights as they stand in that order.
Lights in_order(const Lights& lights, const LightOrder& order);

}  // namespace mis
