#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace mis {

/// The samples that every point gets in one round, per replicate, are as many as it takes to have
/// some tens of rounds in all: strategies alternate in small rounds, so that a drifting machine
/// touches all alike.
struct Plan {
    int replicates = 16;
    std::vector<int>
        chunks;         ///< samples per replicate, round by round; for a fixed number of samples
    int remainder = 0;  ///< samples per point that do not divide among the replicates
};

/// For a fixed number of samples per point: 16 replicates, or as many as have two samples each.
inline Plan plan_for(std::uint64_t spp)
{
    Plan plan;
    plan.replicates = static_cast<int>(std::clamp<std::uint64_t>(spp / 2, 1, 16));
    std::uint64_t left = spp / static_cast<std::uint64_t>(plan.replicates);
    plan.remainder = static_cast<int>(spp % static_cast<std::uint64_t>(plan.replicates));
    const std::uint64_t usual = std::clamp<std::uint64_t>(left / 12, 2, 64);
    while (left > 0) {
        const std::uint64_t chunk = left < 2 * usual ? left : usual;
        plan.chunks.push_back(static_cast<int>(chunk));
        left -= chunk;
    }
    return plan;
}

/// The next round's samples per replicate where time is the limit. seconds_left: wall;
/// round_seconds: of one sample per replicate of all strategies. 0: no round of two samples fits.
inline int next_chunk(int rounds_so_far, double seconds_left, double round_seconds)
{
    const int wanted = rounds_so_far < 3 ? 2 : rounds_so_far < 6 ? 4 : rounds_so_far < 9 ? 8 : 16;
    const double fit = round_seconds > 0 ? seconds_left / round_seconds : wanted;
    if (fit < 2) return 0;
    return static_cast<int>(std::min<double>(wanted, fit));
}

/// The order of n strategies in a round: a shuffle of its own.
std::vector<std::size_t> round_order(std::size_t n, std::uint64_t seed, std::uint32_t round);

}  // namespace mis
