#pragma once

#include "mis/technique/cone.h"

namespace mis {

/// The cone's draw, seen as one technique over the union of the caps: the lecture's "union of the
/// directions".
struct UnionTechnique : ConeTechnique {
    static constexpr std::string_view name = "union";
    static constexpr std::string_view summary =
        "the cone's draw, priced over all lights along the direction";
    static constexpr std::string_view ranked_by_default_with = "all/light";
    static constexpr bool sums_lights = true;
};
static_assert(LightTechnique<UnionTechnique, float>);

}  // namespace mis
