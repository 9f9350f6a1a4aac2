#pragma once

#include "mis/stats/measurements.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace mis {

/// The samples (or scramblings: observations) that every point gets in one round, per replicate,
/// are as many as it takes to have some tens of rounds in all: strategies alternate in small
/// rounds, so that a drifting machine touches all alike.
struct SamplePlan {
    int replicates = most_replicates;
    int parts = 1;  ///< rounds that the replicates take turns in: more and shorter rounds, which
                    ///< tell the times better
    std::vector<int>
        chunks;         ///< samples per replicate, round by round; for a fixed number of samples
    int remainder = 0;  ///< samples per point that do not divide among the replicates
};

/// For a fixed number of samples per point: 16 replicates, or as many as have two samples each.
inline SamplePlan plan_for(std::uint64_t spp)
{
    SamplePlan plan;
    plan.replicates = static_cast<int>(std::clamp<std::uint64_t>(spp / 2, 1, most_replicates));
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

/// Samples per point of a first round, about.
inline constexpr int first_samples = 32;

/// SamplePlan::parts where there is time for few rounds: so many that there are half a dozen, at
/// most 4.
inline int parts_for(double round_seconds, double seconds)
{
    return std::bit_ceil(
        static_cast<unsigned>(std::clamp(std::ceil(6 * round_seconds / seconds), 1.0, 4.0)));
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

/// Is this round's time an observation? Of the first 1024 each, then 512 in each doubling: short
/// rounds by the million would tell no more, and have to be sorted at every look.
inline bool is_round_timed(std::uint32_t round)
{
    constexpr std::uint32_t in_a_doubling = 512;
    return round % std::max(1U, std::bit_floor(round / in_a_doubling)) == 0;
}

/// How looks at growing measurements share the probabilities of error among them: half of it by the
/// square of the elapsed part of the time allowed, less what was spent before (Kim and DeMets 1987,
/// ρ = 2), the rest at the end. Early looks, which decide little, spend little; all together spend
/// at most 1.
class ErrorSpending {
public:
    /// What the look at this part of the time, in [0, 1], may spend.
    double spend_at(double elapsed)
    {
        const double all = std::max(0.5 * std::min(1.0, elapsed * elapsed), spent_);
        return all - std::exchange(spent_, all);
    }
    /// What the last look may spend.
    double spend_rest() { return 1 - std::exchange(spent_, 1.0); }

private:
    double spent_ = 0;
};

/// The order of n strategies in a round: a shuffle of its own.
std::vector<std::size_t> round_order(std::size_t n, std::uint64_t seed, std::uint32_t round);

}  // namespace mis
