#pragma once

#include "mis/engine/batch.h"
#include "mis/learn/seen_counts.h"
#include "mis/scene/light.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace mis {

// How a round's draws are spread over the lights of one point: each heavy light is a stratum of its
// own, all the others are one. docs/theory.md §26.

/// What is known at a point before a round. By place of the tables, padded to a multiple of 16 with
/// lights of share 0.
template <class S> struct StrataKnowledge {
    std::span<const S> share;  ///< of a light in what the point would reflect unshaded; Σ = 1
    SeenCounts<S> counts;      ///< of the point's own draws
    std::span<const S> block;  ///< means of its block of neighbours
};

/// The lights of a point in two parts. Room is the caller's.
template <class S> struct StrataParts {
    std::span<S> rest;             ///< [place] P √v of the lights that are not heavy; 0 of others
    std::span<double> block_sums;  ///< Σ rest over each 16 places
    double rest_sum = 0;           ///< Σ rest
    double rest_seen = 0;          ///< Σ P v over the rest: what of it is expected to be seen
    std::span<std::uint32_t> heavy_place;  ///< at least draws/2
    std::span<S> heavy_spread;  ///< deviation of a draw, over what the point reflects unshaded
    std::size_t heavy = 0;      ///< how many there are
};

/// Expected draws of a light in a round, as a policy's table says probabilities.
template <class T> struct ExpectedDraws {
    const T* of_place;
    MIS_INLINE double probability(LightIndex place) const
    {
        return static_cast<double>(of_place[place]);
    }
};

/// What the numbers of a batch's draws go by, row by row.
struct StrataColumns {
    alignas(64) Column<std::uint32_t> stratum, number;  ///< StratumDraw's
    alignas(64) Column<std::uint32_t> key_u,
        key_v;  ///< of the point and the round, then of the stratum
};

/// Of the variance of being seen: what so few draws do not tell, and what edges leave.
inline constexpr double doubt_of_seen = 0.25, least_variance_of_seen = 0.002;

}  // namespace mis
