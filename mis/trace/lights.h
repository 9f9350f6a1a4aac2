#pragma once

#include "mis/math/sphere.h"
#include "mis/scene/light.h"

#include <algorithm>
#include <array>
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
        walk(x, wi, everything, [&](const LightHit& hit) {
            visit(hit);
            return everything;
        });
    }

    std::size_t bytes() const
    {
        return nodes_.size() * sizeof(Node) + order_.size() * sizeof(LightIndex);
    }

private:
    struct Node {
        std::array<float, 3> low, high;  ///< relative to origin_
        std::uint32_t
            first;  ///< leaf: of order_; else the right child (the left one is the next node)
        std::uint32_t count;  ///< of a leaf; 0 for an inner node
    };
    struct Builder;

    /// meet(hit) for the lights along wi up to `limit`; it returns the distance beyond which
    /// nothing is of interest.
    template <class Meet>
    void walk(const Vec3<double>& x, const Vec3<double>& wi, double limit, const Meet& meet) const;

    const Lights* lights_;
    Vec3<double> origin_{0};
    std::vector<Node> nodes_;
    std::vector<LightIndex> order_;
};

/// A ray as the boxes see it: float, with a margin for the rounding of its origin.
class BoxRay {
public:
    MIS_INLINE BoxRay(const Vec3<double>& origin, const Vec3<double>& direction)
    {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            origin_[a] = static_cast<float>(origin[axis]);
            margin_[a] = std::abs(origin_[a]) * 1.2e-7F;
            const float d = static_cast<float>(direction[axis]);
            inverse_[a] = 1 / (std::abs(d) > 1e-30F ? d : std::copysign(1e-30F, d));
        }
    }
    MIS_INLINE bool meets(const std::array<float, 3>& low, const std::array<float, 3>& high,
                          float limit) const
    {
        float near = 0, far = limit;
        for (std::size_t a = 0; a < 3; ++a) {
            const float t0 = (low[a] - margin_[a] - origin_[a]) * inverse_[a];
            const float t1 = (high[a] + margin_[a] - origin_[a]) * inverse_[a];
            near = std::max(near, std::min(t0, t1));
            far = std::min(far, std::max(t0, t1));
        }
        return near <= far * 1.000001F;  // Ize 2013, "Robust BVH Ray Traversal"
    }

private:
    std::array<float, 3> origin_{}, margin_{}, inverse_{};
};

template <class Meet>
void LightHierarchy::walk(const Vec3<double>& x, const Vec3<double>& wi, double limit,
                          const Meet& meet) const
{
    if (nodes_.empty()) return;
    const BoxRay ray(x - origin_, wi);
    float box_limit = static_cast<float>(limit) * 1.000001F;
    std::array<std::uint32_t, 64> stack;  // NOLINT: filled before it is read
    std::size_t depth = 0;
    std::uint32_t current = 0;
    while (true) {
        const Node& node = nodes_[current];
        if (ray.meets(node.low, node.high, box_limit)) {
            if (node.count == 0) {
                stack[depth++] = node.first;
                ++current;
                continue;
            }
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                const Light& light = (*lights_)[static_cast<std::size_t>(order_[i])];
                const Vec3<double> to_center = light.center - x;
                if (!meets_sphere(to_center, light.radius, wi)) continue;
                const double distance = hit_distance(to_center, light.radius, wi);
                if (distance <= limit && distance < std::numeric_limits<double>::infinity()) {
                    limit = meet(LightHit{order_[i], distance});
                    box_limit = static_cast<float>(limit) * 1.000001F;
                }
            }
        }
        if (depth == 0) return;
        current = stack[--depth];
    }
}

}  // namespace mis
