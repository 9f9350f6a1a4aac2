#include "mis/trace/lights.h"

#include <cmath>

namespace mis {

namespace {

constexpr std::uint32_t leaf_size = 4;
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

}  // namespace

/// Splits by the surface-area heuristic over 16 bins of the centres (Wald 2007).
struct LightHierarchy::Builder {
    LightHierarchy& tree;

    Box bounds(std::uint32_t first, std::uint32_t end) const
    {
        Box box;
        for (std::uint32_t i = first; i < end; ++i) {
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

    void build(std::uint32_t first, std::uint32_t end, int depth)
    {
        const std::size_t self = tree.nodes_.size();
        const Box box = bounds(first, end);
        Node node{};
        for (int axis = 0; axis < 3; ++axis) {
            node.low[static_cast<std::size_t>(axis)] = rounded_down(box.low[axis]);
            node.high[static_cast<std::size_t>(axis)] = rounded_up(box.high[axis]);
        }
        node.first = first;
        node.count = end - first <= leaf_size ? end - first : 0;
        tree.nodes_.push_back(node);
        if (node.count != 0) return;
        const std::uint32_t middle = split(first, end, depth);
        build(first, middle, depth + 1);
        tree.nodes_[self].first = static_cast<std::uint32_t>(tree.nodes_.size());
        build(middle, end, depth + 1);
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

LightHierarchy::LightHierarchy(const Lights& lights) : lights_(&lights), order_(lights.size())
{
    if (lights.empty()) return;
    origin_ = middle_of(lights);
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<LightIndex>(i);
    nodes_.reserve(order_.size());
    Builder{*this}.build(0, static_cast<std::uint32_t>(order_.size()), 0);
    nodes_.shrink_to_fit();
}

bool LightHierarchy::contains(const Vec3<double>& x) const
{
    if (nodes_.empty()) return false;
    const Vec3<float> p = vec_cast<float>(x - origin_);
    std::array<std::uint32_t, 64> stack;  // NOLINT: filled before it is read
    std::size_t depth = 0;
    std::uint32_t current = 0;
    while (true) {
        const Node& node = nodes_[current];
        bool inside = true;
        for (std::size_t a = 0; a < 3; ++a) {
            const float c = p[static_cast<int>(a)], margin = std::abs(c) * 1.2e-7F;
            inside = inside && node.low[a] - margin <= c && c <= node.high[a] + margin;
        }
        if (inside && node.count == 0) {
            stack[depth++] = node.first;
            ++current;
            continue;
        }
        for (std::uint32_t i = node.first; inside && i < node.first + node.count; ++i) {
            const Light& light = (*lights_)[static_cast<std::size_t>(order_[i])];
            if (length(light.center - x) <= light.radius) return true;
        }
        if (depth == 0) return false;
        current = stack[--depth];
    }
}

LightHit LightHierarchy::nearest(const Vec3<double>& x, const Vec3<double>& wi) const
{
    LightHit best;
    walk(x, wi, best.distance, [&](const LightHit& hit) {
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
    walk(x, wi, hit.distance, [&](const LightHit& other) {
        if (other.light == hit.light || other.distance > hit.distance) return hit.distance;
        if (other.distance < hit.distance || other.light < hit.light) hidden = true;
        return hidden ? 0.0 : hit.distance;
    });
    return hidden;
}

}  // namespace mis
