#include "mis/policy/light_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace mis {

namespace {

constexpr auto group_size = static_cast<std::uint32_t>(LightTree::width);

/// What it takes to split: a centre in float, relative to the tree's origin.
struct TreeItem {
    std::array<float, 3> center;
    LightIndex light;
};

/// A range of the items, a whole number of groups but for the last one.
struct TreeRange {
    std::uint32_t first, end;
    std::uint32_t groups() const { return (end - first + group_size - 1) / group_size; }
};

/// The middle of the centres along an axis, by median, so that a far sun does not move it.
double median(const Lights& lights, int axis)
{
    std::vector<double> along;
    const std::size_t step = std::max<std::size_t>(1, lights.size() / 4096);
    for (std::size_t j = 0; j < lights.size(); j += step) along.push_back(lights[j].center[axis]);
    const auto middle = along.begin() + static_cast<std::ptrdiff_t>(along.size() / 2);
    std::nth_element(along.begin(), middle, along.end());
    return *middle;
}

}  // namespace

/// Splits by halves across the axis along which the centres vary most, down to groups of 16, all
/// of which are full but the last.
struct LightTree::Builder {
    LightTree& tree;
    const Lights& all;
    const StopToken& stop;
    double total_power = 0;
    LargeVector<TreeItem> items = {};

    void run()
    {
        const Vec3<double> middle{median(all, 0), median(all, 1), median(all, 2)};
        const auto count = static_cast<std::uint32_t>(all.size());
        items.reserve(count);
        for (std::uint32_t j = 0; j < count; ++j) {
            const Vec3<float> c = vec_cast<float>(all[j].center - middle);
            items.push_back({{c.x, c.y, c.z}, static_cast<LightIndex>(j)});
            total_power += luminance_radius(all[j]) * all[j].radius;
        }
        tree.slot_of_.resize(count);
        tree.lights_.resize(TreeRange{0, count}.groups());
        tree.nodes_.emplace_back();
        build(0, {0, count});
        const Description whole = described({0, count});
        tree.middle_ = whole.mean, tree.reach_ = whole.reach;
    }

    const Light& light_of(const TreeItem& item) const
    {
        return all[static_cast<std::size_t>(item.light)];
    }

    /// Fills the group `self` with parts of the range: as many as hold a power of 16 of groups
    /// each, so that every level below is as full as can be.
    void build(std::size_t self, const TreeRange& range)
    {
        std::uint32_t capacity = 1;  // groups of lights in one part
        while (capacity * group_size < range.groups()) capacity *= group_size;
        std::array<TreeRange, width> parts;  // NOLINT: split fills it
        std::uint32_t count = 0;
        split(range, (range.groups() + capacity - 1) / capacity, parts, count);
        NodeGroup node{};
        node.count = count;
        node.is_lowest = capacity == 1 ? 1 : 0;
        const auto first_child = static_cast<std::uint32_t>(tree.nodes_.size());
        if (node.is_lowest == 0) tree.nodes_.resize(tree.nodes_.size() + count);
        node.first.fill(std::numeric_limits<std::uint32_t>::max());
        node.child = node.is_lowest != 0 ? parts[0].first / group_size : first_child;
        std::array<Description, width> described_parts;  // NOLINT: filled as far as it is read
        for (std::uint32_t k = 0; k < count; ++k) {
            stop.check();
            node.first[k] = parts[k].first / group_size;
            if (node.is_lowest != 0) fill_lights(node.child + k, parts[k]);
            else build(node.child + k, parts[k]);
            described_parts[k] = described(parts[k]);
        }
        describe(node, std::span(described_parts).first(count));
        tree.nodes_[self] = node;
    }

    void split(const TreeRange& range, std::uint32_t parts, std::array<TreeRange, width>& found,
               std::uint32_t& count)
    {
        if (parts == 1) {
            found[count++] = range;
            return;
        }
        stop.check();
        const std::uint32_t left = parts / 2;
        const auto groups =
            static_cast<std::uint32_t>(std::uint64_t{range.groups()} * left / parts);
        const std::uint32_t middle = range.first + groups * group_size;
        const std::size_t axis = widest_axis(range);
        const auto at = [&](std::uint32_t i) { return items.begin() + i; };
        std::nth_element(at(range.first), at(middle), at(range.end),
                         [axis](const TreeItem& a, const TreeItem& b) {
                             return a.center[axis] < b.center[axis];
                         });
        split({range.first, middle}, left, found, count);
        split({middle, range.end}, parts - left, found, count);
    }

    std::size_t widest_axis(const TreeRange& range) const
    {
        std::array<double, 3> sum{}, sum2{};
        for (std::uint32_t i = range.first; i < range.end; ++i)
            for (std::size_t a = 0; a < 3; ++a) {
                const double c = static_cast<double>(items[i].center[a]);
                sum[a] += c, sum2[a] += c * c;
            }
        const double n = static_cast<double>(range.end - range.first);
        std::array<double, 3> variance;  // NOLINT
        for (std::size_t a = 0; a < 3; ++a) variance[a] = sum2[a] / n - sum[a] / n * (sum[a] / n);
        return static_cast<std::size_t>(std::max_element(variance.begin(), variance.end()) -
                                        variance.begin());
    }

    /// visit(centre, radius, share of the power) for the lights of a range.
    template <class Visit> void for_each_light(const TreeRange& range, const Visit& visit) const
    {
        for (std::uint32_t i = range.first; i < range.end; ++i) {
            const LightGroup& group = tree.lights_[i / group_size];
            const std::size_t k = i % group_size;
            visit(Vec3<double>(group.x[k], group.y[k], group.z[k]), group.radius[k],
                  group.luminance_radius[k] * group.radius[k]);
        }
    }

    /// Eq. 65.
    struct Description {
        Vec3<double> mean, variance;
        double power, reach;
    };

    /// A range whose lights are in their groups already.
    Description described(const TreeRange& range) const
    {
        double power = 0;
        Vec3<double> sum{0}, plain{0};
        for_each_light(range, [&](const Vec3<double>& center, double, double share) {
            power += share, sum += share * center, plain += center;
        });
        const Vec3<double> mean =
            power > 0 ? sum / power : plain / static_cast<double>(range.end - range.first);
        Vec3<double> squares{0};
        double reach = 0;
        for_each_light(range, [&](const Vec3<double>& center, double radius, double share) {
            const Vec3<double> away = center - mean;
            squares += share * (away * away + radius * radius / 4);
            reach = std::max(reach, length(away) + radius);
        });
        const Vec3<double> variance = power > 0 ? squares / power : Vec3<double>(0);
        return {mean, variance, power, reach};
    }

    /// The parts of a node. Its origin is their middle one along each axis, which no far sun moves;
    /// what floats round off their places is added to their reach.
    static void describe(NodeGroup& node, std::span<const Description> parts)
    {
        for (int axis = 0; axis < 3; ++axis) {
            std::array<double, width> along;  // NOLINT: filled as far as it is read
            for (std::size_t k = 0; k < parts.size(); ++k) along[k] = parts[k].mean[axis];
            const auto middle = along.begin() + static_cast<std::ptrdiff_t>(parts.size() / 2);
            std::nth_element(along.begin(), middle,
                             along.begin() + static_cast<std::ptrdiff_t>(parts.size()));
            node.origin[axis] = *middle;
        }
        for (std::size_t k = 0; k < parts.size(); ++k) {
            const Description& part = parts[k];
            const Vec3<double> away = part.mean - node.origin;
            const Vec3<float> place = vec_cast<float>(away);
            node.x[k] = place.x, node.y[k] = place.y, node.z[k] = place.z;
            node.sx[k] = static_cast<float>(std::sqrt(part.variance.x));
            node.sy[k] = static_cast<float>(std::sqrt(part.variance.y));
            node.sz[k] = static_cast<float>(std::sqrt(part.variance.z));
            node.reach[k] = static_cast<float>(part.reach * (1 + 0x1p-20) + 0x1p-20 * length(away));
            node.power[k] = part.power > 0 ? std::max(static_cast<float>(part.power), 1e-35F) : 0;
        }
    }

    void fill_lights(std::uint32_t number, const TreeRange& range)
    {
        LightGroup& group = tree.lights_[number];
        for (std::uint32_t k = 0; k < group_size; ++k) {
            const bool is_there = range.first + k < range.end;
            const TreeItem& item = items[is_there ? range.first + k : range.first];
            const Light& light = light_of(item);
            const Vec3<double>& c = light.center;
            group.x[k] = c.x, group.y[k] = c.y, group.z[k] = c.z;
            group.radius[k] = light.radius;
            group.luminance_radius[k] =
                is_there && total_power > 0 ? luminance_radius(light) / total_power : 0;
            group.light[k] = is_there ? item.light : no_light;
            if (is_there)
                tree.slot_of_[static_cast<std::size_t>(item.light)] = number * group_size + k;
        }
    }
};

LightTree::LightTree(const Lights& lights, const StopToken& stop)
{
    if (lights.empty()) return;
    Builder{*this, lights, stop}.run();
    nodes_.shrink_to_fit();
}

}  // namespace mis
