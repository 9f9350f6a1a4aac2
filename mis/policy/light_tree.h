#pragma once

#include "mis/math/stop_token.h"
#include "mis/scene/light.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace mis {

/// A hierarchy over lights, to choose among them: groups of up to 16 lights that stand together,
/// groups of up to 16 such groups, and so on. Of each part it keeps what it takes to guess what the
/// part is worth at a point (docs/theory.md, eqs. 65 to 69). Places and lengths are in scene units,
/// powers are shares of the power of all lights. 51 bytes per light where there are thousands.
class LightTree {
public:
    static constexpr std::size_t width = 16;

    /// Takes what it needs of the lights. O(M log M), wherever they stand. Throws
    /// Stopped.
    explicit LightTree(const Lights& lights, const StopToken& stop = {});

    template <class N> using Row = std::array<N, width>;

    /// Up to 16 lights. The places that are left over hold black ones.
    struct alignas(64) LightGroup {
        Row<double> x, y, z, radius;
        Row<double> luminance_radius;  ///< such that times radius it is the share of
                                       ///< the power
        Row<LightIndex> light;
    };
    /// Up to 16 parts, each with the group that it is made of. Floats, relative to a place among
    /// them: what a part is worth is a guess.
    struct alignas(64) NodeGroup {
        Row<float> power;
        Row<float> x, y, z;     ///< mean place of its power, from `origin`
        Row<float> reach;       ///< the ball of this radius about there holds all its lights
        Row<float> sx, sy, sz;  ///< standard deviation of the place of its power
        Vec3<double> origin{0};
        std::uint32_t child = 0;      ///< of part 0: of nodes(), or of lights() if is_lowest
        std::uint32_t count = 0;      ///< parts; the others have no power
        std::uint32_t is_lowest = 0;  ///< are its parts groups of lights?
        Row<std::uint32_t> first;     ///< number of its first group of lights
    };

    /// The first is the root.
    std::span<const NodeGroup> nodes() const { return nodes_; }
    std::span<const LightGroup> lights() const { return lights_; }
    /// 16 times the number of a light's group, and its place there.
    std::uint32_t slot_of(LightIndex light) const
    {
        return slot_of_[static_cast<std::size_t>(light)];
    }
    /// The ball of this radius about there holds all lights.
    const Vec3<double>& middle() const { return middle_; }
    double reach() const { return reach_; }

    std::size_t bytes() const
    {
        return nodes_.size() * sizeof(NodeGroup) + lights_.size() * sizeof(LightGroup) +
               slot_of_.size() * sizeof(std::uint32_t);
    }

private:
    struct Builder;

    LargeVector<NodeGroup> nodes_;
    LargeVector<LightGroup> lights_;
    LargeVector<std::uint32_t> slot_of_;
    Vec3<double> middle_{0};
    double reach_ = 0;
};

}  // namespace mis
