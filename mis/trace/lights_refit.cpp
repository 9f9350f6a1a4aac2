#include "mis/trace/light_grid.h"
#include "mis/trace/lights.h"

#include <array>
#include <cassert>

namespace mis {

/// Finds the node that names a light by where the light was, and widens or narrows the boxes from
/// there to the root.
struct LightHierarchy::Refit {
    LightHierarchy& tree;
    LightIndex light;
    LightBox before;

    /// Is the light below this node? Then its boxes are right again.
    bool visit(Node& node)
    {
        if (!names(node) && !is_below(node)) return false;
        std::array<LightBox, LightNode::width> boxes;
        LightBox around;
        const std::size_t count = node.nodes + node.lights;
        for (std::size_t k = 0; k < count; ++k) {
            boxes[k] = k < node.nodes
                           ? extent(tree.nodes_[node.first_node + k])
                           : bounds_of((*tree.lights_)[static_cast<std::size_t>(named(node, k))],
                                       tree.origin_);
            around.add(boxes[k]);
        }
        LightGrid grid(node, around);
        for (std::size_t k = 0; k < count; ++k) grid.put(k, boxes[k]);
        return true;
    }

private:
    LightIndex named(const Node& node, std::size_t k) const
    {
        return tree.order_[node.first_light + k - node.nodes];
    }
    bool names(const Node& node) const
    {
        for (std::size_t k = node.nodes; k < std::size_t{node.nodes} + node.lights; ++k)
            if (named(node, k) == light) return true;
        return false;
    }
    bool is_below(const Node& node)
    {
        for (std::size_t k = 0; k < node.nodes; ++k)
            if (holds_before(node, k) && visit(tree.nodes_[node.first_node + k])) return true;
        return false;
    }
    bool holds_before(const Node& node, std::size_t k) const
    {
        for (std::size_t a = 0; a < 3; ++a) {
            const auto axis = static_cast<int>(a);
            const auto step = static_cast<double>(node.step[a]);
            if (static_cast<double>(node.low_origin[a]) + node.low[a][k] * step > before.low[axis])
                return false;
            if (static_cast<double>(node.high_origin[a]) + node.high[a][k] * step <
                before.high[axis])
                return false;
        }
        return true;
    }
    /// The whole of a node's grid.
    static LightBox extent(const Node& node)
    {
        LightBox box;
        for (std::size_t a = 0; a < 3; ++a) {
            const auto axis = static_cast<int>(a);
            box.low[axis] = static_cast<double>(node.low_origin[a]);
            box.high[axis] =
                static_cast<double>(node.high_origin[a]) + 255 * static_cast<double>(node.step[a]);
        }
        return box;
    }
};

void LightHierarchy::refit(LightIndex j, const Light& before)
{
    Refit refit{*this, j, bounds_of(before, origin_)};
    [[maybe_unused]] const bool found = refit.visit(nodes_[0]);
    assert(found && "before: where light j stood");
}

}  // namespace mis
