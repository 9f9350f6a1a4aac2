#pragma once

#include "mis/math/stable.h"

#include <cstddef>
#include <span>

namespace mis {

// What earlier draws teach of a light: how likely it is seen. Draws and those that saw their light
// are counted at the tile, the block of neighbours, and the point; each posterior mean is the prior
// of the next. Never 0: what was never seen is not known to be hidden. docs/theory.md, eq. 90.

/// How much a block's mean weighs at a point, or a tile's in a block: as so many draws.
inline constexpr double draws_of_prior = 2;

/// Posterior mean of being seen, where `seen` of `drawn` draws saw their light; of a tile, whose
/// prior is 1 and weighs as one draw.
template <class V> MIS_INLINE V seen_in_tile(const V& seen, const V& drawn)
{
    return (seen + number<V>(1)) / (drawn + number<V>(1));
}

/// The same of a block or a point, by the mean of what it is a part of.
template <class V> MIS_INLINE V seen_within(const V& seen, const V& drawn, const V& whole)
{
    const V prior = number<V>(draws_of_prior);
    return (seen + prior * whole) / (drawn + prior);
}

/// Draws of some lights, and how many of these saw their light; one number per light.
template <class S> struct SeenCounts {
    std::span<S> drawn, seen;

    void add(std::size_t light, bool is_seen)
    {
        drawn[light] += S(1);
        seen[light] += S(is_seen);
    }
};

}  // namespace mis
