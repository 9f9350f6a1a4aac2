#pragma once

#include "mis/heuristic/heuristic.h"

namespace mis {

/// Veach's balance heuristic (Veach and Guibas 1995; Veach 1997, §9.2.2; docs/theory.md, eq. 23).
struct BalanceHeuristic {
    static constexpr std::string_view name = "balance";
    static constexpr std::string_view summary = "in proportion to the density";
    static constexpr bool ranked_by_default(std::size_t, bool) { return true; }
    template <class T, std::size_t N>
    MIS_INLINE static T weight(const std::array<T, N>& density, std::size_t i)
    {
        T sum = number<T>(0);
        for (const T& d : density) sum += density_ratio(d, density[i]);
        return weight_if_possible(density[i], number<T>(1) / sum);
    }
};
static_assert(Heuristic<BalanceHeuristic, float>);

}  // namespace mis
