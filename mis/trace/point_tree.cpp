#include "mis/trace/point_tree.h"

#include <algorithm>
#include <numeric>

namespace mis {

PointTree::PointTree(std::span<const Vec3<double>> points) : order_(points.size())
{
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    if (!points.empty()) build(points, 0, static_cast<std::uint32_t>(points.size()));
}

void PointTree::build(std::span<const Vec3<double>> points, std::uint32_t first, std::uint32_t end)
{
    constexpr std::uint32_t few = 4;
    Node node{points[order_[first]], points[order_[first]], first, end, 0};
    for (std::uint32_t k = first; k < end; ++k) {
        node.low = glm::min(node.low, points[order_[k]]);
        node.high = glm::max(node.high, points[order_[k]]);
    }
    const std::size_t self = nodes_.size();
    nodes_.push_back(node);
    if (end - first > few) {
        const Vec3<double> extent = node.high - node.low;
        const int yz = extent.y >= extent.z ? 1 : 2, axis = extent.x >= extent[yz] ? 0 : yz;
        const std::uint32_t middle = first + (end - first) / 2;
        std::nth_element(
            order_.begin() + first, order_.begin() + middle, order_.begin() + end,
            [&](std::uint32_t a, std::uint32_t b) { return points[a][axis] < points[b][axis]; });
        build(points, first, middle);
        build(points, middle, end);
    }
    nodes_[self].next = static_cast<std::uint32_t>(nodes_.size());
}

}  // namespace mis
