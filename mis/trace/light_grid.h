#pragma once

#include "mis/scene/light.h"
#include "mis/trace/light_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace mis {

// How the hierarchy over the lights is filled: exact boxes, put onto the grids of its nodes.

/// An exact box around some lights, relative to the tree's origin.
struct LightBox {
    Vec3<double> low{std::numeric_limits<double>::infinity()},
        high{-std::numeric_limits<double>::infinity()};
    void add(const LightBox& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
};

inline LightBox bounds_of(const Light& light, const Vec3<double>& origin)
{
    const Vec3<double> center = light.center - origin;
    return {center - light.radius, center + light.radius};
}

/// The widest float box around a double one: two roundings outwards, for the box and for a radius.
inline float rounded_down(double x)
{
    return std::nextafter(std::nextafter(static_cast<float>(x), -3e38F), -3e38F);
}
inline float rounded_up(double x)
{
    return std::nextafter(std::nextafter(static_cast<float>(x), 3e38F), 3e38F);
}

/// Puts boxes onto the grid of a node, outwards.
class LightGrid {
public:
    LightGrid(LightNode& node, const LightBox& around) : node_(node)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const float origin = rounded_down(around.low[axis]);
            const double extent = around.high[axis] - static_cast<double>(origin);
            const float step = std::max(rounded_up(extent / 255 * (1 + 1e-6)), 1e-30F);
            const float margin = 1e-6F * (std::abs(origin) + 255 * step);
            node.step[a] = step;
            node.low_origin[a] = origin - margin, node.high_origin[a] = origin + margin;
            origin_[axis] = static_cast<double>(origin);
        }
    }
    void put(std::size_t child, const LightBox& box)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const auto step = static_cast<double>(node_.step[a]);
            const double low = std::floor((box.low[axis] - origin_[axis]) / step),
                         high = std::ceil((box.high[axis] - origin_[axis]) / step);
            node_.low[a][child] = static_cast<std::uint8_t>(std::clamp(low, 0.0, 255.0));
            node_.high[a][child] = static_cast<std::uint8_t>(std::clamp(high, 0.0, 255.0));
        }
    }

private:
    LightNode& node_;
    Vec3<double> origin_{0};
};

}  // namespace mis
