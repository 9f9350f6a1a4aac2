#include "mis/trace/lights.h"

#include <algorithm>
#include <cmath>

namespace mis {

namespace {

/// May p be in the box of child k?
bool may_hold(const LightNode& node, std::size_t k, const Vec3<float>& p)
{
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const float margin = 1e-6F * std::abs(p[axis]);
        const float low = node.low_origin[a] + static_cast<float>(node.low[a][k]) * node.step[a],
                    high = node.high_origin[a] + static_cast<float>(node.high[a][k]) * node.step[a];
        if (p[axis] < low - margin || p[axis] > high + margin) return false;
    }
    return true;
}

}  // namespace

bool LightHierarchy::contains(const Vec3<double>& x) const
{
    if (nodes_.empty()) return false;
    const Vec3<float> p = vec_cast<float>(x - origin_);
    std::array<std::uint32_t, WaitingNodes::most> stack;  // NOLINT: filled before it is read
    std::size_t depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const Node& node = nodes_[stack[--depth]];
        for (std::uint32_t k = 0; k < std::uint32_t{node.nodes} + node.lights; ++k) {
            if (!may_hold(node, k, p)) continue;
            if (k < node.nodes) {
                stack[depth++] = node.first_node + k;
                continue;
            }
            const auto j = static_cast<std::size_t>(order_[node.first_light + k - node.nodes]);
            const Light& light = (*lights_)[j];
            if (length(light.center - x) <= light.radius) return true;
        }
    }
    return false;
}

LightHit LightHierarchy::nearest(const Vec3<double>& x, const Vec3<double>& wi,
                                 std::span<const ListedLight> others) const
{
    LightHit best;
    for (const LightIndex j : others) {
        const LightHit hit{j, distance_to(j, x, wi)};
        if (hit.distance < std::numeric_limits<double>::infinity() && stands_before(hit, best))
            best = hit;
    }
    return best;
}

bool LightHierarchy::hides(const Vec3<double>& x, const Vec3<double>& wi, const LightHit& hit,
                           std::span<const ListedLight> others) const
{
    return std::any_of(others.begin(), others.end(), [&](LightIndex j) {
        return stands_before({j, distance_to(j, x, wi)}, hit);
    });
}

}  // namespace mis
