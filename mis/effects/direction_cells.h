#pragma once

#include "mis/math/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace mis {

/// All directions in 32 × 32 cells: an octahedron, unfolded to a square (Cigolle et al. 2014, "A
/// Survey of Efficient Representations for Independent Unit Vectors", §4).
class DirectionCells {
public:
    static constexpr std::size_t side = 32, count = side * side;

    /// The cone that just holds a cell, with 1e-5 rad of room for rounding.
    struct Cone {
        Vec3<double> axis;
        double sine;  ///< of half its opening
    };
    static const std::array<Cone, count>& cones();

    /// The cell that a direction is in; wi need not be of length 1.
    static std::size_t of(const Vec3<float>& wi)
    {
        const float sum = std::abs(wi.x) + std::abs(wi.y) + std::abs(wi.z);
        if (!(sum > 0)) return 0;
        const float scale = 1 / sum;
        float u = wi.x * scale, v = wi.y * scale;
        if (wi.z < 0) {
            const float folded = std::copysign(1 - std::abs(v), u);
            v = std::copysign(1 - std::abs(u), v), u = folded;
        }
        return place(v) * side + place(u);
    }

private:
    static std::size_t place(float u)
    {
        constexpr float half = side / 2;
        return std::min(static_cast<std::size_t>(std::max(half + half * u, 0.0F)), side - 1);
    }
};

}  // namespace mis
