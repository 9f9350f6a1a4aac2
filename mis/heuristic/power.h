#pragma once

#include "mis/heuristic/heuristic.h"

namespace mis {

/// Veach's power heuristic with β = 2 (Veach 1997, §9.2.3; docs/theory.md, eq. 23).
struct PowerHeuristic {
    static constexpr std::string_view name = "power";
    static constexpr std::string_view summary = "in proportion to the squared density";
    static constexpr bool ranked_by_default(std::size_t, bool) { return true; }
    template <class T, std::size_t N>
    MIS_INLINE static T weight(const std::array<T, N>& density, std::size_t i)
    {
        T sum = number<T>(0);
        // Divide, then square: p² overflows, the ratio does not.
        for (const T& d : density) sum += square(density_ratio(d, density[i]));
        return weight_if_possible(density[i], number<T>(1) / sum);
    }
};
static_assert(Heuristic<PowerHeuristic, float>);

}  // namespace mis
