#pragma once

#include "mis/math/four_floats.h"
#include "mis/math/sphere.h"
#include "mis/scene/light.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace mis {

/// The light that a direction meets, and how far; light is no_light and distance infinity where it
/// meets none.
struct LightHit {
    LightIndex light = no_light;
    double distance = std::numeric_limits<double>::infinity();
};

/// Which light does a direction meet first, and whose caps hold it? A bounding volume hierarchy
/// over the spheres, which never enter the surfaces' tree. Boxes are float and wide enough for
/// every rounding; what they let through is tested in double, so the answers are those of a loop
/// over all lights. Directions are unit vectors.
class LightHierarchy {
public:
    /// Keeps a reference to the lights.
    explicit LightHierarchy(const Lights& lights);

    /// Is x inside a light or on it?
    bool contains(const Vec3<double>& x) const;

    /// The nearest light along wi from x, which lies outside all lights; at equal distance the one
    /// listed first.
    LightHit nearest(const Vec3<double>& x, const Vec3<double>& wi) const;

    /// Does another light than `light`, which is met at `distance`, stand before it?
    bool hides(const Vec3<double>& x, const Vec3<double>& wi, const LightHit& hit) const;

    /// visit(LightHit) for every light along wi, hidden ones too, in no order.
    template <class Visit>
    void for_each_along(const Vec3<double>& x, const Vec3<double>& wi, const Visit& visit) const
    {
        constexpr double everything = std::numeric_limits<double>::infinity();
        walk(x, wi, everything, no_light, [&](const LightHit& hit) {
            visit(hit);
            return everything;
        });
    }

    std::size_t bytes() const
    {
        return nodes_.size() * sizeof(Node) + order_.size() * sizeof(LightIndex);
    }

    /// Children of a node: their boxes are tested together, in lanes.
    static constexpr std::size_t width = 8;

    /// Up to eight boxes, on a grid of 255 steps across the box around them all. Its first children
    /// are nodes, the others single lights.
    struct Node {
        /// Of the grid; origins are relative to the tree's, one for lower and one for upper bounds,
        /// apart by the room for rounding.
        std::array<float, 3> low_origin, high_origin, step;
        std::array<std::array<std::uint8_t, width>, 3> low, high;  ///< [axis][child], in steps
        std::uint32_t first_node, first_light;                     ///< of nodes_; of order_
        std::uint8_t nodes, lights;
    };

private:
    struct Builder;

    /// meet(hit) for the lights along wi up to `limit`, but for one; it returns the distance beyond
    /// which nothing is of interest.
    template <class Meet>
    void walk(const Vec3<double>& x, const Vec3<double>& wi, double limit, LightIndex but,
              const Meet& meet) const;

    const Lights* lights_;
    Vec3<double> origin_{0};
    std::vector<Node> nodes_;
    std::vector<LightIndex> order_;
};

/// Nodes that wait while one is looked at, and where the ray enters them: at most 7 on each of 50
/// levels, and room to write eight at once.
struct WaitingNodes {
    static constexpr std::size_t most = 352 + LightHierarchy::width;
    std::array<std::uint32_t, most> node;  // NOLINT: filled before it is read
    std::array<float, most> near;          // NOLINT
    std::size_t count = 0;
};

/// A ray as the boxes see it: in float, every box wider by what rounding may come to, which is
/// below 1e-6 of the coordinates at hand: three roundings of t (Ize 2013, "Robust BVH Ray
/// Traversal"), one of the origin and one of the direction. The fourth numbers are padding.
struct BoxRay {
    BoxRay(const Vec3<double>& from, const Vec3<double>& direction)
    {
        const Vec3<float> o = vec_cast<float>(from), d = vec_cast<float>(direction);
        const FourFloats at = four(o.x, o.y, o.z, 0);
        const FourFloats margin = magnitude(at) * four(1e-6F);
        put(at - margin, low_origin.data());
        put(at + margin, high_origin.data());
        put(four(1) / four(not_zero(d.x), not_zero(d.y), not_zero(d.z), 1), inverse.data());
    }

    /// Puts the children that are nodes and whose boxes the ray meets before `limit` onto the
    /// stack; returns the lights whose boxes it meets: bit k is light `first_light` + k.
    std::uint32_t open(const LightHierarchy::Node& node, float limit, WaitingNodes& stack) const
    {
        return open_node(*this, node, limit, stack);
    }

    alignas(16) std::array<float, 4> low_origin{}, high_origin{}, inverse{};

private:
    using OpenNode = std::uint32_t (*)(const BoxRay&, const LightHierarchy::Node&, float limit,
                                       WaitingNodes&);
    static float not_zero(float d) { return std::abs(d) > 1e-20F ? d : std::copysign(1e-20F, d); }

    /// By the widest vectors that this processor has; all give the same bits.
    static const OpenNode open_node;
};

template <class Meet>
void LightHierarchy::walk(const Vec3<double>& x, const Vec3<double>& wi, double limit,
                          LightIndex but, const Meet& meet) const
{
    if (nodes_.empty()) return;
    const BoxRay ray(x - origin_, wi);
    WaitingNodes stack;  // NOLINT
    stack.node[0] = 0, stack.near[0] = 0, stack.count = 1;
    float box_limit = static_cast<float>(limit) * 1.000001F;
    while (stack.count > 0) {
        const std::size_t next = --stack.count;
        if (stack.near[next] > box_limit) continue;
        const Node& node = nodes_[stack.node[next]];
        for (std::uint32_t met = ray.open(node, box_limit, stack); met != 0; met &= met - 1) {
            const LightIndex j =
                order_[node.first_light + static_cast<std::uint32_t>(std::countr_zero(met))];
            if (j == but) continue;
            const Light& light = (*lights_)[static_cast<std::size_t>(j)];
            const Vec3<double> to_center = light.center - x;
            if (!meets_sphere(to_center, light.radius, wi)) continue;
            const double distance = hit_distance(to_center, light.radius, wi);
            if (distance <= limit && distance < std::numeric_limits<double>::infinity()) {
                limit = meet(LightHit{j, distance});
                box_limit = static_cast<float>(limit) * 1.000001F;
            }
        }
    }
}

}  // namespace mis
