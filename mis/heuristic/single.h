#pragma once

#include "mis/heuristic/heuristic.h"

namespace mis {

/// One technique alone: all of the first density, the light's. A BSDF draw has no part in it.
struct SingleHeuristic {
    static constexpr std::string_view name = "light";
    static constexpr std::string_view summary = "the light draw alone, no BSDF draw";
    static constexpr bool ranked_by_default(std::size_t, bool) { return true; }
    template <class T, std::size_t N>
    MIS_INLINE static T weight(const std::array<T, N>& density, std::size_t i)
    {
        return weight_if_possible(density[i], number<T>(i == 0 ? 1 : 0));
    }
};
static_assert(Heuristic<SingleHeuristic, float>);

}  // namespace mis
