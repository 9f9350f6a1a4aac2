#pragma once

#include "mis/heuristic/heuristic.h"

namespace mis {

/// Veach's maximum heuristic (Veach 1997, §9.2.3): all to the largest density; a tie goes to the
/// first, the light.
struct MaximumHeuristic {
    static constexpr std::string_view name = "maximum";
    static constexpr std::string_view summary = "all to the largest density";
    template <class T, std::size_t N>
    MIS_INLINE static T weight(const std::array<T, N>& density, std::size_t i)
    {
        const T one = number<T>(1), zero = number<T>(0);
        T weight = one;
        for (std::size_t k = 0; k < i; ++k) weight = select(density[k] < density[i], weight, zero);
        for (std::size_t k = i + 1; k < N; ++k)
            weight = select(density[k] > density[i], zero, weight);
        return weight_if_possible(density[i], weight);
    }
};
static_assert(Heuristic<MaximumHeuristic, float>);

}  // namespace mis
