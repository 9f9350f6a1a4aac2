#pragma once

#include "mis/math/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace mis {

/// Some points in boxes within boxes: which of them lie in a given box? Halved across the axis that
/// they spread over most, down to a few.
class PointTree {
public:
    explicit PointTree(std::span<const Vec3<double>> points);

    /// visit(i) for every point i with low ≤ point ≤ high, and for some beside.
    template <class Visit>
    void for_each_near(const Vec3<double>& low, const Vec3<double>& high, const Visit& visit) const
    {
        for (std::uint32_t at = 0; at < nodes_.size();) {
            const Node& node = nodes_[at];
            if (!meet(node, low, high)) {
                at = node.next;
                continue;
            }
            if (node.next == at + 1)
                for (std::uint32_t k = node.first; k < node.end; ++k) visit(order_[k]);
            ++at;
        }
    }

private:
    struct Node {
        Vec3<double> low, high;
        std::uint32_t first, end;  ///< of order_
        std::uint32_t next;        ///< node after all that are below this one
    };

    static bool meet(const Node& node, const Vec3<double>& low, const Vec3<double>& high)
    {
        return node.low.x <= high.x && node.high.x >= low.x && node.low.y <= high.y &&
               node.high.y >= low.y && node.low.z <= high.z && node.high.z >= low.z;
    }
    void build(std::span<const Vec3<double>> points, std::uint32_t first, std::uint32_t end);

    std::vector<Node> nodes_;  ///< each before those below it
    std::vector<std::uint32_t> order_;
};

}  // namespace mis
