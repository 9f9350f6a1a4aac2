#include "mis/sampling/discrete.h"

#include <algorithm>

namespace mis {

AliasTable::AliasTable(std::span<const double> weights)
{
    // Scaled by the largest first: the sum of weights near the end of the range stays finite.
    const double largest = weights.empty() ? 0 : *std::max_element(weights.begin(), weights.end());
    if (!(largest > 0)) return;
    double total = 0;
    for (const double w : weights) total += w / largest;

    const std::size_t n = weights.size();
    std::vector<double> share(n);  // of a cell: 1 is full
    std::vector<std::uint32_t> small, large;
    cells_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        const double probability = weights[i] / largest / total;
        share[i] = probability * static_cast<double>(n);
        cells_[i] = {1.0F, static_cast<std::uint32_t>(i), static_cast<float>(probability)};
        (share[i] < 1 ? small : large).push_back(static_cast<std::uint32_t>(i));
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t poor = small.back(), rich = large.back();
        small.pop_back();
        cells_[poor].border = border_at(share[poor]);
        cells_[poor].alias = rich;
        share[rich] -= 1 - share[poor];
        if (share[rich] < 1) {
            large.pop_back();
            small.push_back(rich);
        }
    }
    // What is left is full but for rounding; a weight of 0 must not be drawn from its own cell all
    // the same.
    for (const std::uint32_t i : small) {
        if (weights[i] > 0) continue;
        cells_[i].border = 0;
        cells_[i].alias = static_cast<std::uint32_t>(
            std::max_element(weights.begin(), weights.end()) - weights.begin());
    }
}

}  // namespace mis
