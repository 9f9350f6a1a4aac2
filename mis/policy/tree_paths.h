#pragma once

#include "mis/math/lanes.h"
#include "mis/policy/light_tree.h"

#include <algorithm>
#include <span>

namespace mis {

/// Weights → their running sums. Is their total positive?
MIS_INLINE bool sum_up(LightTree::Row<double>& weights)
{
    for (std::size_t k = 1; k < LightTree::width; ++k) weights[k] += weights[k - 1];
    return weights.back() > 0;
}

/// The probability of place k, from the running sums; 0 where all are.
MIS_INLINE double share_of(const LightTree::Row<double>& sums, std::size_t k)
{
    const double before = k > 0 ? sums[k - 1] : 0;
    return sums.back() > 0 ? (sums[k] - before) / sums.back() : 0;
}

/// The path of a draw: at each group a place in proportion to the weights. The remainder of the
/// uniform number, within the place that it fell into, is uniform again and goes on: of 53 bits a
/// light of probability P has log2(1/P) spent, so it is drawn as often as is said to 2⁻⁵³/P.
class DrawnPath {
public:
    MIS_INLINE explicit DrawnPath(std::uint64_t bits)
        : u_(static_cast<double>(static_cast<std::int64_t>(bits >> 11)) * 0x1p-53)
    {
    }
    /// Precondition: the sums' total is positive.
    MIS_INLINE std::size_t light(const LightTree::Row<double>& sums)
    {
        // Below the total even when the product rounds up to it.
        const double target = u_ * (1 - 0x1p-52) * sums.back();
        std::size_t k = 0;
        for (std::size_t i = 0; i + 1 < LightTree::width; ++i)
            k += static_cast<std::size_t>(sums[i] <= target);
        const double before = k > 0 ? sums[k - 1] : 0;
        u_ = std::min((target - before) / (sums[k] - before), 1 - 0x1p-53);
        return k;
    }
    MIS_INLINE std::size_t part(const LightTree::Row<double>& sums, const LightTree::NodeGroup&)
    {
        return light(sums);
    }

private:
    double u_;
};

/// The path to a given light.
class KnownPath {
public:
    MIS_INLINE explicit KnownPath(std::uint32_t slot)
        : group_(slot / LightTree::width), place_(slot % LightTree::width)
    {
    }
    MIS_INLINE std::size_t light(const LightTree::Row<double>&) const { return place_; }
    MIS_INLINE std::size_t part(const LightTree::Row<double>&,
                                const LightTree::NodeGroup& parts) const
    {
        std::size_t k = 0;
        for (std::size_t i = 1; i < LightTree::width; ++i)
            k += static_cast<std::size_t>(parts.first[i] <= group_);
        return k;
    }

private:
    std::uint32_t group_;  ///< of lights
    std::size_t place_;
};

/// A group that was looked into before any draw.
struct OpenGroup {
    std::uint32_t group = 0;
    bool is_of_lights = false;
    LightTree::Row<std::uint8_t> opened{};  ///< number of the open group of each part; 0: none
    LightTree::Row<double> sums{};          ///< weights, then their running sums
};

/// Which part to open next: the one most in doubt. At most `most` groups.
template <class S, std::size_t most> class OpenOrder {
public:
    struct From {
        std::uint8_t group, part;
    };

    /// Another group: room for the doubts about its parts.
    MIS_INLINE LightTree::Row<S>& add()
    {
        is_doubted_[count_] = true;
        return doubts_[count_++];
    }
    MIS_INLINE void add_without_doubt() { most_doubt_[count_] = 0, is_doubted_[count_++] = false; }

    /// The part that is most in doubt, as a group to look into; noted in `open` as opened. False if
    /// none is in doubt.
    MIS_INLINE bool next(std::span<OpenGroup> open, const LightTree& tree, OpenGroup& found)
    {
        if (is_doubted_[count_ - 1]) find_most(count_ - 1);
        std::size_t g = 0, k = 0;
        for (std::size_t i = 1; i < count_; ++i)
            if (most_doubt_[i] > most_doubt_[g]) g = i;
        if (!(most_doubt_[g] > 0)) return false;
        while (doubts_[g][k] != most_doubt_[g]) ++k;
        doubts_[g][k] = 0;
        find_most(g);
        from_[count_] = {static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(k)};
        open[g].opened[k] = static_cast<std::uint8_t>(count_);
        const LightTree::NodeGroup& parts = tree.nodes()[open[g].group];
        found.group = parts.child[k], found.is_of_lights = parts.is_lowest != 0;
        return true;
    }

    /// Of which part of which open group is open group i? i > 0.
    const From& from(std::size_t i) const { return from_[i]; }

private:
    MIS_INLINE void find_most(std::size_t group)
    {
        S largest = 0;
        for (const S doubt : doubts_[group]) largest = doubt > largest ? doubt : largest;
        most_doubt_[group] = largest;
    }

    std::size_t count_ = 0;
    std::array<bool, most> is_doubted_;           // NOLINT: as all here, filled by add
    std::array<LightTree::Row<S>, most> doubts_;  // NOLINT
    std::array<S, most> most_doubt_;              // NOLINT
    std::array<From, most> from_;                 // NOLINT
};

}  // namespace mis
