#include "mis/trace/lights.h"

#include <cmath>

namespace mis {

namespace {

constexpr int bins = 16;

struct Box {
    Vec3<double> low{std::numeric_limits<double>::infinity()},
        high{-std::numeric_limits<double>::infinity()};
    void add(const Vec3<double>& p) { low = glm::min(low, p), high = glm::max(high, p); }
    void add(const Box& b) { low = glm::min(low, b.low), high = glm::max(high, b.high); }
    double half_area() const
    {
        const Vec3<double> e = high - low;
        return e.x < 0 ? 0 : e.x * e.y + e.y * e.z + e.z * e.x;
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

/// The middle of the lights' centres, by median, so that a far sun does not move it.
Vec3<double> middle_of(const Lights& lights)
{
    Vec3<double> middle{0};
    std::vector<double> coordinates(lights.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(lights.begin(), lights.end(), coordinates.begin(),
                       [axis](const Light& light) { return light.center[axis]; });
        const auto half = coordinates.begin() + static_cast<std::ptrdiff_t>(coordinates.size() / 2);
        std::nth_element(coordinates.begin(), half, coordinates.end());
        middle[axis] = *half;
    }
    return middle;
}

/// A range of the order, and the box around its lights.
struct Range {
    std::uint32_t first, end;
    std::uint32_t count() const { return end - first; }
};

/// Puts boxes onto the grid of a node, outwards.
class Grid {
public:
    Grid(LightHierarchy::Node& node, const Box& around) : node_(node)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            node.origin[a] = rounded_down(around.low[axis]);
            const double extent = around.high[axis] - static_cast<double>(node.origin[a]);
            node.step[a] = std::max(rounded_up(extent / 255 * (1 + 1e-6)), 1e-30F);
        }
    }
    void put(std::size_t child, const Box& box)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const double origin = static_cast<double>(node_.origin[a]),
                         step = static_cast<double>(node_.step[a]);
            const double low = std::floor((box.low[axis] - origin) / step),
                         high = std::ceil((box.high[axis] - origin) / step);
            node_.low[a][child] = static_cast<std::uint8_t>(std::clamp(low, 0.0, 255.0));
            node_.high[a][child] = static_cast<std::uint8_t>(std::clamp(high, 0.0, 255.0));
        }
    }

private:
    LightHierarchy::Node& node_;
};

}  // namespace

/// Splits by the surface-area heuristic over 16 bins of the centres (Wald 2007), eight at a time.
struct LightHierarchy::Builder {
    LightHierarchy& tree;
    std::vector<LightIndex> leaves = {};  ///< the order in which nodes name their lights

    Box bounds(const Range& range) const
    {
        Box box;
        for (std::uint32_t i = range.first; i < range.end; ++i) {
            const Light& light = light_at(i);
            box.add(light.center - tree.origin_ - light.radius);
            box.add(light.center - tree.origin_ + light.radius);
        }
        return box;
    }
    const Light& light_at(std::uint32_t i) const
    {
        return (*tree.lights_)[static_cast<std::size_t>(tree.order_[i])];
    }

    /// Fills node `self` with the lights of `range`.
    void build(std::size_t self, const Range& range, int depth)
    {
        std::vector<Range> inner, single;
        for (const Range& part : children_of(range, depth))
            (part.count() > 1 ? inner : single).push_back(part);
        Node node{};
        Grid grid(node, bounds(range));
        node.nodes = static_cast<std::uint8_t>(inner.size());
        node.lights = static_cast<std::uint8_t>(single.size());
        node.first_node = static_cast<std::uint32_t>(tree.nodes_.size());
        node.first_light = static_cast<std::uint32_t>(leaves.size());
        for (std::size_t k = 0; k < inner.size(); ++k) grid.put(k, bounds(inner[k]));
        for (std::size_t k = 0; k < single.size(); ++k) {
            grid.put(inner.size() + k, bounds(single[k]));
            leaves.push_back(tree.order_[single[k].first]);
        }
        tree.nodes_[self] = node;
        tree.nodes_.resize(tree.nodes_.size() + inner.size());
        for (std::size_t k = 0; k < inner.size(); ++k)
            build(node.first_node + k, inner[k], depth + 3);
    }

    /// At most eight parts: as few as hold at most eight lights each; in the room that is left,
    /// small ones light by light.
    std::vector<Range> children_of(const Range& range, int depth)
    {
        std::vector<Range> parts{range};
        const auto by_count = [](const Range& a, const Range& b) { return a.count() < b.count(); };
        while (parts.size() < width) {
            const auto largest = std::max_element(parts.begin(), parts.end(), by_count);
            if (largest->count() <= width) break;
            const std::uint32_t middle = split(largest->first, largest->end, depth);
            const Range right{middle, largest->end};
            largest->end = middle;
            parts.push_back(right);
        }
        std::sort(parts.begin(), parts.end(), by_count);
        std::size_t room = width - parts.size();
        std::vector<Range> opened;
        for (const Range& part : parts) {
            const bool opens = part.count() <= room + 1;
            for (std::uint32_t i = part.first; opens && i < part.end; ++i)
                opened.push_back({i, i + 1});
            if (opens) room -= part.count() - 1;
            else opened.push_back(part);
        }
        return opened;
    }

    /// Orders the range in two and gives the border. Deep down it halves, so that depth stays below
    /// the walk's stack.
    std::uint32_t split(std::uint32_t first, std::uint32_t end, int depth)
    {
        Box centers;
        for (std::uint32_t i = first; i < end; ++i) centers.add(light_at(i).center);
        const Vec3<double> extent = centers.high - centers.low;
        const int axis =
            extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
        const auto begin_it = tree.order_.begin() + first, end_it = tree.order_.begin() + end;
        if (extent[axis] > 0 && depth < 24) {
            const double scale = bins / extent[axis] * (1 - 1e-9);
            const auto bin_of = [&](const Light& light) {
                return static_cast<int>((light.center[axis] - centers.low[axis]) * scale);
            };
            const int border = best_border(first, end, bin_of);
            const auto middle = std::partition(begin_it, end_it, [&](LightIndex j) {
                return bin_of((*tree.lights_)[static_cast<std::size_t>(j)]) < border;
            });
            if (middle != begin_it && middle != end_it)
                return static_cast<std::uint32_t>(middle - tree.order_.begin());
        }
        const auto half = begin_it + (end - first) / 2;
        std::nth_element(begin_it, half, end_it, [&](LightIndex a, LightIndex b) {
            return (*tree.lights_)[static_cast<std::size_t>(a)].center[axis] <
                   (*tree.lights_)[static_cast<std::size_t>(b)].center[axis];
        });
        return static_cast<std::uint32_t>(half - tree.order_.begin());
    }

    template <class BinOf>
    int best_border(std::uint32_t first, std::uint32_t end, const BinOf& bin_of) const
    {
        std::array<Box, bins> box;
        std::array<std::uint32_t, bins> count{};
        for (std::uint32_t i = first; i < end; ++i) {
            const Light& light = light_at(i);
            const auto bin = static_cast<std::size_t>(bin_of(light));
            box[bin].add(light.center - light.radius);
            box[bin].add(light.center + light.radius);
            ++count[bin];
        }
        std::array<double, bins> right_cost{};
        Box right;
        std::uint32_t right_count = 0;
        for (std::size_t b = bins - 1; b > 0; --b) {
            right.add(box[b]);
            right_cost[b] = right.half_area() * (right_count += count[b]);
        }
        Box left;
        std::uint32_t left_count = 0;
        double least = std::numeric_limits<double>::infinity();
        int border = bins / 2;
        for (std::size_t b = 1; b < bins; ++b) {
            left.add(box[b - 1]);
            const double cost = left.half_area() * (left_count += count[b - 1]) + right_cost[b];
            if (cost < least) least = cost, border = static_cast<int>(b);
        }
        return border;
    }
};

namespace {

/// May p be in the box of child k?
bool may_hold(const LightHierarchy::Node& node, std::size_t k, const Vec3<float>& p)
{
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const float margin =
            1e-6F * (std::abs(p[axis]) + std::abs(node.origin[a]) + 255 * node.step[a]);
        const float low = node.origin[a] + static_cast<float>(node.low[a][k]) * node.step[a],
                    high = node.origin[a] + static_cast<float>(node.high[a][k]) * node.step[a];
        if (p[axis] < low - margin || p[axis] > high + margin) return false;
    }
    return true;
}

}  // namespace

LightHierarchy::LightHierarchy(const Lights& lights) : lights_(&lights), order_(lights.size())
{
    if (lights.empty()) return;
    origin_ = middle_of(lights);
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<LightIndex>(i);
    nodes_.reserve(order_.size() / 3 + 1);
    nodes_.resize(1);
    Builder builder{*this};
    builder.build(0, {0, static_cast<std::uint32_t>(order_.size())}, 0);
    order_ = std::move(builder.leaves);
    nodes_.shrink_to_fit();
}

bool LightHierarchy::contains(const Vec3<double>& x) const
{
    if (nodes_.empty()) return false;
    const Vec3<float> p = vec_cast<float>(x - origin_);
    std::array<std::uint32_t, most_waiting> stack;  // NOLINT: filled before it is read
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

LightHit LightHierarchy::nearest(const Vec3<double>& x, const Vec3<double>& wi) const
{
    LightHit best;
    walk(x, wi, best.distance, no_light, [&](const LightHit& hit) {
        if (hit.distance < best.distance ||
            (hit.distance == best.distance && hit.light < best.light))
            best = hit;
        return best.distance;
    });
    return best;
}

bool LightHierarchy::hides(const Vec3<double>& x, const Vec3<double>& wi, const LightHit& hit) const
{
    bool hidden = false;
    walk(x, wi, hit.distance, hit.light, [&](const LightHit& other) {
        if (other.distance > hit.distance) return hit.distance;
        if (other.distance < hit.distance || other.light < hit.light) hidden = true;
        return hidden ? 0.0 : hit.distance;
    });
    return hidden;
}

}  // namespace mis
