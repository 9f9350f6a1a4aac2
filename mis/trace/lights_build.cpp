#include "mis/trace/lights.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mis {

namespace {

constexpr std::size_t bins = 16;

/// What it takes to split: a sphere in float, relative to the tree's origin. Exact bounds come from
/// the light itself, once.
struct Item {
    std::array<float, 4> sphere;  ///< centre, radius
    LightIndex light;
};

/// An exact box around some lights, relative to the tree's origin.
struct Box {
    Vec3<double> low{std::numeric_limits<double>::infinity()},
        high{-std::numeric_limits<double>::infinity()};
    void add(const Box& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
};

Box bounds(const Light& light, const Vec3<double>& origin)
{
    const Vec3<double> center = light.center - origin;
    return {center - light.radius, center + light.radius};
}

/// A rough box, of which only the area counts. The fourth number means nothing.
struct RoughBox {
    FourFloats low = four(std::numeric_limits<float>::infinity()),
               high = four(-std::numeric_limits<float>::infinity());
    void add(const RoughBox& b) { low = smaller(low, b.low), high = larger(high, b.high); }
    void add_point(FourFloats p) { low = smaller(low, p), high = larger(high, p); }
    void add_sphere(const std::array<float, 4>& sphere)
    {
        const FourFloats center = four_of(sphere.data());
        low = smaller(low, center + four(-sphere[3]));
        high = larger(high, center + four(sphere[3]));
    }
    std::array<float, 4> extent() const
    {
        std::array<float, 4> extent;  // NOLINT: put fills it
        put(high + low * four(-1), extent.data());
        return extent;
    }
    float half_area() const
    {
        const std::array<float, 4> e = extent();
        return e[0] < 0 ? 0 : e[0] * e[1] + e[1] * e[2] + e[2] * e[0];
    }
};

/// The widest float box around a double one: two roundings outwards, for the box and for a radius.
float rounded_down(double x)
{
    return std::nextafter(std::nextafter(static_cast<float>(x), -3e38F), -3e38F);
}
float rounded_up(double x)
{
    return std::nextafter(std::nextafter(static_cast<float>(x), 3e38F), 3e38F);
}

/// The middle of the lights' centres, by median, so that a far sun does not move it: of all of them
/// where they are few, else of some thousand spread over the list.
Vec3<double> middle_of(const Lights& lights)
{
    const std::size_t step = std::max<std::size_t>(1, lights.size() / 4096);
    Vec3<double> middle{0};
    std::vector<double> coordinates;
    for (int axis = 0; axis < 3; ++axis) {
        coordinates.clear();
        for (std::size_t i = 0; i < lights.size(); i += step)
            coordinates.push_back(lights[i].center[axis]);
        const auto half = coordinates.begin() + static_cast<std::ptrdiff_t>(coordinates.size() / 2);
        std::nth_element(coordinates.begin(), half, coordinates.end());
        middle[axis] = *half;
    }
    return middle;
}

/// A range of the items.
struct Range {
    std::uint32_t first, end;
    std::uint32_t count() const { return end - first; }
};

/// Puts boxes onto the grid of a node, outwards.
class Grid {
public:
    Grid(LightNode& node, const Box& around) : node_(node)
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
    void put(std::size_t child, const Box& box)
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

}  // namespace

/// Splits by the surface-area heuristic over 16 bins of the centres (Wald 2007), eight at a time.
struct LightHierarchy::Builder {
    LightHierarchy& tree;
    const StopToken& stop;
    LargeVector<Item> items = {};
    LargeVector<LightIndex> leaves = {};  ///< the order in which nodes name their lights

    void run()
    {
        const auto count = static_cast<std::uint32_t>(tree.lights_->size());
        items.resize(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            const Light& light = (*tree.lights_)[i];
            const Vec3<float> center = vec_cast<float>(light.center - tree.origin_);
            items[i] = {{center.x, center.y, center.z, static_cast<float>(light.radius)},
                        static_cast<LightIndex>(i)};
        }
        leaves.reserve(count);
        tree.nodes_.reserve(count / 3 + 1);
        tree.nodes_.resize(1);
        build(0, {0, count}, 0);
    }

    Box bounds_of(LightIndex index) const
    {
        return bounds((*tree.lights_)[static_cast<std::size_t>(index)], tree.origin_);
    }

    /// Fills node `self` with the lights of `range`; the box around them.
    Box build(std::size_t self, const Range& range, int depth)
    {
        std::array<Range, LightNode::width> parts;  // NOLINT: filled before it is read
        const std::size_t count = children_of(range, depth, parts);
        const auto end = parts.begin() + static_cast<std::ptrdiff_t>(count);
        const auto singles = std::stable_partition(
            parts.begin(), end, [](const Range& part) { return part.count() > 1; });
        const auto inner = static_cast<std::size_t>(singles - parts.begin());
        Node node{};
        node.nodes = static_cast<std::uint8_t>(inner);
        node.lights = static_cast<std::uint8_t>(count - inner);
        node.first_node = static_cast<std::uint32_t>(tree.nodes_.size());
        node.first_light = static_cast<std::uint32_t>(leaves.size());
        for (std::size_t k = inner; k < count; ++k) leaves.push_back(items[parts[k].first].light);
        tree.nodes_.resize(tree.nodes_.size() + inner);
        std::array<Box, LightNode::width> boxes;
        Box around;
        for (std::size_t k = 0; k < count; ++k) {
            boxes[k] = k < inner ? build(node.first_node + k, parts[k], depth + 3)
                                 : bounds_of(items[parts[k].first].light);
            around.add(boxes[k]);
        }
        Grid grid(node, around);
        for (std::size_t k = 0; k < count; ++k) grid.put(k, boxes[k]);
        tree.nodes_[self] = node;
        return around;
    }

    /// At most eight parts: as few as hold at most eight lights each; in the room that is left,
    /// small ones light by light. Returns how many.
    std::size_t children_of(const Range& range, int depth,
                            std::array<Range, LightNode::width>& found)
    {
        std::array<Range, LightNode::width> parts;  // NOLINT: filled before it is read
        std::size_t count = 0;
        parts[count++] = range;
        const auto by_count = [](const Range& a, const Range& b) { return a.count() < b.count(); };
        const auto end = [&] { return parts.begin() + static_cast<std::ptrdiff_t>(count); };
        while (count < LightNode::width) {
            const auto largest = std::max_element(parts.begin(), end(), by_count);
            if (largest->count() <= LightNode::width) break;
            const std::uint32_t middle = split(*largest, depth);
            parts[count++] = {middle, largest->end};
            largest->end = middle;
        }
        std::sort(parts.begin(), end(), by_count);
        std::size_t room = LightNode::width - count, opened = 0;
        for (auto part = parts.begin(); part != end(); ++part) {
            const bool opens = part->count() <= room + 1;
            for (std::uint32_t i = part->first; opens && i < part->end; ++i)
                found[opened++] = {i, i + 1};
            if (opens) room -= part->count() - 1;
            else found[opened++] = *part;
        }
        return opened;
    }

    /// Orders the range in two and gives the border. Deep down it halves, so that depth stays below
    /// the walk's stack.
    std::uint32_t split(const Range& range, int depth)
    {
        stop.check();
        const auto begin = items.begin() + range.first, end = items.begin() + range.end;
        RoughBox centers;
        for (auto item = begin; item != end; ++item)
            centers.add_point(four_of(item->sphere.data()));
        const std::array<float, 4> extent = centers.extent();
        const auto axis = static_cast<std::size_t>(
            std::max_element(extent.begin(), extent.begin() + 3) - extent.begin());
        if (extent[axis] > 0 && depth < 24) {
            std::array<float, 4> low;  // NOLINT: put fills it
            put(centers.low, low.data());
            const float scale = static_cast<float>(bins) / extent[axis];
            const auto bin_of = [&](const Item& item) {
                return std::min(static_cast<std::size_t>((item.sphere[axis] - low[axis]) * scale),
                                bins - 1);
            };
            const std::size_t border = best_border(begin, end, bin_of);
            const auto middle =
                std::partition(begin, end, [&](const Item& item) { return bin_of(item) < border; });
            if (middle != begin && middle != end)
                return static_cast<std::uint32_t>(middle - items.begin());
        }
        const auto half = begin + range.count() / 2;
        std::nth_element(begin, half, end, [&](const Item& a, const Item& b) {
            return a.sphere[axis] < b.sphere[axis];
        });
        return static_cast<std::uint32_t>(half - items.begin());
    }

    template <class Iterator, class BinOf>
    static std::size_t best_border(Iterator begin, Iterator end, const BinOf& bin_of)
    {
        std::array<RoughBox, bins> box;
        std::array<std::uint32_t, bins> count{};
        for (auto item = begin; item != end; ++item) {
            const std::size_t bin = bin_of(*item);
            box[bin].add_sphere(item->sphere);
            ++count[bin];
        }
        std::array<float, bins> right_cost{};
        RoughBox right;
        std::uint32_t right_count = 0;
        for (std::size_t b = bins - 1; b > 0; --b) {
            right.add(box[b]);
            right_cost[b] = right.half_area() * static_cast<float>(right_count += count[b]);
        }
        RoughBox left;
        std::uint32_t left_count = 0;
        float least = std::numeric_limits<float>::infinity();
        std::size_t border = bins / 2;
        for (std::size_t b = 1; b < bins; ++b) {
            left.add(box[b - 1]);
            const float cost =
                left.half_area() * static_cast<float>(left_count += count[b - 1]) + right_cost[b];
            if (cost < least) least = cost, border = b;
        }
        return border;
    }
};

LightHierarchy::LightHierarchy(const Lights& lights, const StopToken& stop) : lights_(&lights)
{
    if (lights.empty()) return;
    origin_ = middle_of(lights);
    Builder builder{*this, stop};
    builder.run();
    order_ = std::move(builder.leaves);
    nodes_.shrink_to_fit();
}

/// Finds the node that names a light by where the light was, and widens or narrows the boxes from
/// there to the root.
struct LightHierarchy::Refit {
    LightHierarchy& tree;
    LightIndex light;
    Box before;

    /// Is the light below this node? Then its boxes are right again.
    bool visit(Node& node)
    {
        if (!names(node) && !is_below(node)) return false;
        std::array<Box, LightNode::width> boxes;
        Box around;
        const std::size_t count = node.nodes + node.lights;
        for (std::size_t k = 0; k < count; ++k) {
            boxes[k] = k < node.nodes
                           ? extent(tree.nodes_[node.first_node + k])
                           : bounds((*tree.lights_)[static_cast<std::size_t>(named(node, k))],
                                    tree.origin_);
            around.add(boxes[k]);
        }
        Grid grid(node, around);
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
    static Box extent(const Node& node)
    {
        Box box;
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
    Refit refit{*this, j, bounds(before, origin_)};
    [[maybe_unused]] const bool found = refit.visit(nodes_[0]);
    assert(found && "before: where light j stood");
}

}  // namespace mis
