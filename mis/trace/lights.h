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
        std::array<float, 3> origin, step;  ///< of the grid; origin relative to the tree's
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

    /// Nodes that wait while one is looked at: 7 on each of at most 50 levels.
    static constexpr std::size_t most_waiting = 352;

    const Lights* lights_;
    Vec3<double> origin_{0};
    std::vector<Node> nodes_;
    std::vector<LightIndex> order_;
};

/// A ray as the boxes see it: in float, every box wider by what rounding may come to, which is
/// below 1e-6 of the coordinates at hand: three roundings of t (Ize 2013, "Robust BVH Ray
/// Traversal"), one of the origin and one of the direction.
class BoxRay {
public:
    MIS_INLINE BoxRay(const Vec3<double>& origin, const Vec3<double>& direction)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            origin_[a] = static_cast<float>(origin[axis]);
            const float d = static_cast<float>(direction[axis]);
            inverse_[a] = 1 / (std::abs(d) > 1e-20F ? d : std::copysign(1e-20F, d));
        }
    }

    /// Bit k: the ray meets the box of child k before `limit`; near: where, for every child.
    MIS_INLINE std::uint32_t meets(const LightHierarchy::Node& node, float limit,
                                   std::array<float, LightHierarchy::width>& near) const
    {
        FourFloats from_a = four(0), from_b = four(0), to_a = four(limit), to_b = four(limit);
        for (std::size_t a = 0; a < 3; ++a) {
            const float margin =
                1e-6F * (std::abs(origin_[a]) + std::abs(node.origin[a]) + 255 * node.step[a]);
            const FourFloats step = four(node.step[a] * inverse_[a]);
            const FourFloats low = four((node.origin[a] - margin - origin_[a]) * inverse_[a]),
                             high = four((node.origin[a] + margin - origin_[a]) * inverse_[a]);
            const EightFloats low_steps = eight_of(node.low[a].data()),
                              high_steps = eight_of(node.high[a].data());
            narrow(low_steps.a * step + low, high_steps.a * step + high, from_a, to_a);
            narrow(low_steps.b * step + low, high_steps.b * step + high, from_b, to_b);
        }
        put(from_a, &near[0]), put(from_b, &near[4]);
        const std::uint32_t met = not_above(from_a, to_a) | not_above(from_b, to_b) << 4;
        return met & ((1U << (node.nodes + node.lights)) - 1);
    }

private:
    /// The part of [from, to] that is also between t0 and t1, in either order.
    MIS_INLINE static void narrow(const FourFloats& t0, const FourFloats& t1, FourFloats& from,
                                  FourFloats& to)
    {
        from = larger(from, smaller(t0, t1));
        to = smaller(to, larger(t0, t1));
    }

    std::array<float, 3> origin_{}, inverse_{};
};

template <class Meet>
void LightHierarchy::walk(const Vec3<double>& x, const Vec3<double>& wi, double limit,
                          LightIndex but, const Meet& meet) const
{
    if (nodes_.empty()) return;
    struct Waiting {
        std::uint32_t node;
        float near;
    };
    const BoxRay ray(x - origin_, wi);
    std::array<Waiting, most_waiting> stack;  // NOLINT: filled before it is read
    std::array<float, width> near;            // NOLINT
    std::size_t depth = 0;
    float box_limit = static_cast<float>(limit) * 1.000001F;
    stack[depth++] = {0, 0};
    while (depth > 0) {
        const Waiting next = stack[--depth];
        if (next.near > box_limit) continue;
        const Node& node = nodes_[next.node];
        for (std::uint32_t met = ray.meets(node, box_limit, near); met != 0; met &= met - 1) {
            const auto k = static_cast<std::uint32_t>(std::countr_zero(met));
            if (k < node.nodes) {
                stack[depth++] = {node.first_node + k, near[k]};
                continue;
            }
            const LightIndex j = order_[node.first_light + k - node.nodes];
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
