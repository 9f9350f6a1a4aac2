#pragma once

#include <array>
#include <cstddef>

namespace mis {

/// Gauss–Kronrod on [−1, 1]: 15 nodes, of which 7 are Gauss's own, so that the difference of the
/// two sums says how far off the better one can be. Padded to 16 with a node of weight 0, for loops
/// of even length.
struct Rule {
    static constexpr std::size_t nodes = 15, padded = 16;
    std::array<double, padded> x{}, kronrod{}, gauss{};
};

/// The one rule of this room.
const Rule& rule();

/// One number per node.
using NodeColumn = std::array<double, Rule::padded>;

}  // namespace mis
