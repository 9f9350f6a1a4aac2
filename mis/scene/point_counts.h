#pragma once

#include <cstddef>

namespace mis {

/// Of what there is to say about some points, how many it is true of.
struct PointCounts {
    std::size_t seen_from_below = 0;  ///< dark: n·wo ≤ 0
    std::size_t inside_light = 0;     ///< dark: in a light or on it, and not seen from below
    std::size_t facing_no_light = 0;  ///< dark: above all lights, and neither of the two
    std::size_t turned_normals = 0;   ///< SurfaceHit::is_n_behind(); lit or dark
    std::size_t turned_and_dark = 0;  ///< of these, the dark ones

    /// Those of other points, too.
    void add(const PointCounts& other)
    {
        seen_from_below += other.seen_from_below, inside_light += other.inside_light;
        facing_no_light += other.facing_no_light, turned_normals += other.turned_normals;
        turned_and_dark += other.turned_and_dark;
    }
};

}  // namespace mis
