#pragma once

#include "mis/math/stable.h"

#include <array>
#include <concepts>
#include <limits>
#include <string_view>

namespace mis {

// How much does each technique count? weight(density, i): the weight of a draw of technique i where
// the techniques have these densities (n_i · pdf_i, per steradian). Weights sum to 1 over the
// techniques for all densities in [1e-38, 1e38]; a technique of density 0 has weight 0, of infinite
// density 1 (shared where both are). It may have ranked_by_default(lights, has_lobes), as a policy
// has (policy/light_choice.h).

// clang-format off
template <class H, class T>
concept Heuristic = requires(const std::array<T, 2>& density, std::size_t i) {
    { H::name } -> std::convertible_to<std::string_view>;
    { H::summary } -> std::convertible_to<std::string_view>;
    { H::weight(density, i) } -> std::same_as<T>;
};
// clang-format on

/// a/b for a, b ≥ 0; ∞ over 0, but two infinities (and two zeros) are as one to one.
template <class T> MIS_INLINE T density_ratio(const T& a, const T& b)
{
    const T one = number<T>(1);
    const auto is_zero = b == number<T>(0);
    const T ratio = a / select(is_zero, one, b);
    return select(a == b, one,
                  select(is_zero, number<T>(std::numeric_limits<double>::infinity()), ratio));
}

/// `weight`, or 0 where the technique cannot have drawn this.
template <class T> MIS_INLINE T weight_if_possible(const T& density, const T& weight)
{
    return select(density > number<T>(0), weight, number<T>(0));
}

}  // namespace mis
