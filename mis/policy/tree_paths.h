#pragma once

#include "mis/math/lanes.h"
#include "mis/policy/light_tree.h"
#include "mis/sampling/discrete.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

namespace mis {

namespace detail {

/// A row by quarters, which compilers keep in lanes: sums and maxima of them do not wait for one
/// another, nor for memory.
template <class N> struct Quarters {
    static constexpr std::size_t size = LightTree::width / 4;
    static_assert(size == 4);
    using Lanes = typename CompilerLanes<N, size>::Type;
    std::array<Lanes, 4> of;  // NOLINT: filled at once

    MIS_INLINE explicit Quarters(const LightTree::Row<N>& row)
    {
        std::memcpy(of.data(), row.data(), sizeof of);
    }
    MIS_INLINE static void raise_to(Lanes& some, const Lanes& other)
    {
        some = some > other ? some : other;
    }
    MIS_INLINE N largest() const
    {
        Lanes most = of[0];
        for (const Lanes& some : of) raise_to(most, some);
        return std::max(std::max(most[0], most[1]), std::max(most[2], most[3]));
    }
    MIS_INLINE N sum() const
    {
        const Lanes all = (of[0] + of[1]) + (of[2] + of[3]);
        return (all[0] + all[1]) + (all[2] + all[3]);
    }
};

}  // namespace detail

/// Weights → their running sums. Is their total positive? Quarters by themselves first: their sums
/// do not wait for one another.
MIS_INLINE bool sum_up(LightTree::Row<double>& weights)
{
    using Quarters = detail::Quarters<double>;
    constexpr std::size_t quarter = Quarters::size;
    Quarters quarters(weights);
    const Quarters::Lanes none = {},
                          least = none + least_weight(quarters.largest(), LightTree::width);
    for (Quarters::Lanes& some : quarters.of) {
        const auto counts = some > none;
        Quarters::raise_to(some, least);
        some = counts ? some : none;
    }
    // Pairs, then quarters, then all: sums never fall, and stay where a weight is 0.
    for (Quarters::Lanes& some : quarters.of) {
        some += __builtin_shufflevector(some, none, 4, 0, 4, 2);
        some += __builtin_shufflevector(some, none, 4, 4, 1, 1);
    }
    for (std::size_t q = 1; q < quarters.of.size(); ++q)
        quarters.of[q] += quarters.of[q - 1][quarter - 1];
    std::memcpy(weights.data(), quarters.of.data(), sizeof quarters.of);
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
template <class S> struct OpenGroup {
    std::uint32_t group = 0;
    bool is_of_lights = false;
    LightTree::Row<std::uint8_t> opened{};  ///< number of the open group of each part; 0: none
    LightTree::Row<S> doubts;               ///< of its parts; 0 of an even one
    LightTree::Row<double> sums{};          ///< weights, then their running sums
};

/// Which parts to open next: those most in doubt. At most `most` groups.
template <class S, std::size_t most> class OpenOrder {
public:
    struct From {
        std::uint8_t group, part;
    };

    /// The root, or the next of those that were found: the weights and doubts of its parts are
    /// known.
    MIS_INLINE void add(OpenGroup<S>& group)
    {
        total_ += detail::Quarters<double>(group.sums).sum() - replaced_;
        replaced_ = 0;
        most_doubt_[count_] = group.is_of_lights ? 0 : detail::Quarters<S>(group.doubts).largest();
        ++count_;
    }

    /// The part that is most in doubt, as a group to look into; noted in `open` as opened. False if
    /// none is in doubt by more than this share of all weights.
    MIS_INLINE bool next(std::span<OpenGroup<S>> open, const LightTree& tree, double share,
                         OpenGroup<S>& found)
    {
        std::size_t g = 0, k = 0;
        for (std::size_t i = 1; i < count_; ++i)
            if (most_doubt_[i] > most_doubt_[g]) g = i;
        if (!(static_cast<double>(most_doubt_[g]) > share * total_)) return false;
        LightTree::Row<S>& doubts = open[g].doubts;
        for (std::size_t i = LightTree::width; i-- > 0;) k = doubts[i] == most_doubt_[g] ? i : k;
        doubts[k] = 0;
        most_doubt_[g] = detail::Quarters<S>(doubts).largest();
        replaced_ += open[g].sums[k];
        from_[found_] = {static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(k)};
        open[g].opened[k] = static_cast<std::uint8_t>(found_++);
        const LightTree::NodeGroup& parts = tree.nodes()[open[g].group];
        found.group = parts.child + static_cast<std::uint32_t>(k);
        found.is_of_lights = parts.is_lowest != 0;
        return true;
    }

    /// Groups that were added.
    std::size_t count() const { return count_; }

    /// Of which part of which open group is open group i? i > 0.
    const From& from(std::size_t i) const { return from_[i]; }

private:
    std::size_t count_ = 0, found_ = 1;  ///< groups added; found, with the root
    double total_ = 0;                   ///< of the weights of all parts that are not opened
    double replaced_ = 0;                ///< of the weights of the parts that are being opened
    std::array<S, most> most_doubt_;     // NOLINT: as from_, filled by add
    std::array<From, most> from_;        // NOLINT
};

}  // namespace mis
