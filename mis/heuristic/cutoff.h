#pragma once

#include "mis/heuristic/heuristic.h"

namespace mis {

/// Veach's cutoff heuristic with α = 0.1 (Veach 1997, §9.2.3): balance among those of at least a
/// tenth of the largest density; the others count nothing.
struct CutoffHeuristic {
    static constexpr std::string_view name = "cutoff";
    static constexpr std::string_view summary =
        "as balance, but nothing below a tenth of the largest density";
    template <class T, std::size_t N>
    MIS_INLINE static T weight(const std::array<T, N>& density, std::size_t i)
    {
        T largest = density[0], sum = number<T>(0);
        for (const T& d : density) largest = max_of(largest, d);
        for (const T& d : density) {
            const T share = density_ratio(d, largest);
            sum += select(share < number<T>(0.1), number<T>(0), share);
        }
        const T own = density_ratio(density[i], largest);
        return weight_if_possible(density[i],
                                  select(own < number<T>(0.1), number<T>(0), own / sum));
    }
};
static_assert(Heuristic<CutoffHeuristic, float>);

}  // namespace mis
