#include "mis/trace/light_grid.h"
#include "mis/trace/lights.h"

#include <algorithm>
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

    LightBox bounds_of(LightIndex index) const
    {
        return mis::bounds_of((*tree.lights_)[static_cast<std::size_t>(index)], tree.origin_);
    }

    /// Fills node `self` with the lights of `range`; the box around them.
    LightBox build(std::size_t self, const Range& range, int depth)
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
        std::array<LightBox, LightNode::width> boxes;
        LightBox around;
        for (std::size_t k = 0; k < count; ++k) {
            boxes[k] = k < inner ? build(node.first_node + k, parts[k], depth + 3)
                                 : bounds_of(items[parts[k].first].light);
            around.add(boxes[k]);
        }
        LightGrid grid(node, around);
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

}  // namespace mis
