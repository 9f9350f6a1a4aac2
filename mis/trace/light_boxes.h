#pragma once

#include "mis/math/four_floats.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace mis {

/// A node of the hierarchy over the lights: up to eight boxes, on a grid of 255 steps across the
/// box around them all. Its first children are nodes, the others single lights.
struct LightNode {
    /// Children of a node: their boxes are tested together, in lanes.
    static constexpr std::size_t width = 8;

    /// Of the grid; origins are relative to the tree's, one for lower and one for upper bounds,
    /// apart by the room for rounding.
    std::array<float, 3> low_origin, high_origin, step;
    std::array<std::array<std::uint8_t, width>, 3> low, high;  ///< [axis][child], in steps
    std::uint32_t first_node, first_light;  ///< of the hierarchy's nodes; of its order of lights
    std::uint8_t nodes, lights;
};

/// Nodes that wait while one is looked at, and where the ray enters them: at most 7 on each of 50
/// levels, and room to write eight at once.
struct WaitingNodes {
    static constexpr std::size_t most = 352 + LightNode::width;
    std::array<std::uint32_t, most> node;  // NOLINT: filled before it is read
    std::array<float, most> near;          // NOLINT
    std::size_t count = 0;
};

/// A ray as the boxes see it: in float, every box wider by what rounding may come to, which is
/// below 1e-6 of the coordinates at hand: three roundings of t (Ize 2013, "Robust BVH Ray
/// Traversal"), one of the origin and one of the direction. The fourth numbers are padding.
struct BoxRay {
    BoxRay() = default;
    BoxRay(const Vec3<double>& from, const Vec3<double>& direction)
    {
        const Vec3<float> o = vec_cast<float>(from), d = vec_cast<float>(direction);
        const FourFloats at = four(o.x, o.y, o.z, 0);
        const FourFloats margin = magnitude(at) * four(1e-6F);
        put(at - margin, low_origin.data());
        put(at + margin, high_origin.data());
        put(four(1) / four(not_zero(d.x), not_zero(d.y), not_zero(d.z), 1), inverse.data());
    }

    /// Puts the children that are nodes and whose boxes the ray meets before `limit` onto the
    /// stack; returns the lights whose boxes it meets: bit k is light `first_light` + k.
    std::uint32_t open(const LightNode& node, float limit, WaitingNodes& stack) const
    {
        return open_node(*this, node, limit, stack);
    }

    alignas(16) std::array<float, 4> low_origin{}, high_origin{}, inverse{};

private:
    using OpenNode = std::uint32_t (*)(const BoxRay&, const LightNode&, float limit, WaitingNodes&);
    static float not_zero(float d) { return std::abs(d) > 1e-20F ? d : std::copysign(1e-20F, d); }

    /// By the widest vectors that this processor has; all give the same bits.
    static const OpenNode open_node;
};

}  // namespace mis
