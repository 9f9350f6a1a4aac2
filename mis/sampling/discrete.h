#pragma once

#include "mis/math/lanes.h"
#include "mis/math/large_vector.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace mis {

/// A light and how likely it was to be drawn; −1 and 0 where no light can contribute.
struct Choice {
    std::int32_t light;
    double probability;
};

/// An index in proportion to fixed weights, in constant time: Walker's alias method, built as Vose
/// 1991 ("A linear algorithm for generating random numbers with a given distribution"). 12 bytes
/// per weight.
class AliasTable {
public:
    /// weights: not negative, finite. All zero: choose() gives −1.
    explicit AliasTable(std::span<const double> weights);

    /// bits: 64 random bits.
    MIS_INLINE Choice choose(std::uint64_t bits) const
    {
        if (cells_.empty()) return {-1, 0};
        __extension__ using Wide = unsigned __int128;
        const Wide product = static_cast<Wide>(bits) * cells_.size();
        const auto cell = static_cast<std::size_t>(product >> 64);
        const double fraction =
            static_cast<double>(static_cast<std::uint64_t>(product) >> 11) * 0x1p-53;
        const double border = static_cast<double>(cells_[cell].border);
        const bool is_own = (border < 0 ? fraction - 1 : fraction) < border;
        const std::size_t light = is_own ? cell : cells_[cell].alias;
        return {static_cast<std::int32_t>(light), static_cast<double>(cells_[light].probability)};
    }

    MIS_INLINE double probability(std::int32_t light) const
    {
        return cells_.empty()
                   ? 0
                   : static_cast<double>(cells_[static_cast<std::size_t>(light)].probability);
    }

private:
    struct Cell {
        /// Up to where the fraction means the cell's own index: below ½ counted from 0, else,
        /// negative, from 1. So both the rare own index and the thin slice of the alias keep a
        /// float's relative precision: of 10⁷ nearly equal weights, the one that tops up all others
        /// would else be drawn 10 % too often (docs/theory.md §7).
        float border = 1;
        std::uint32_t alias;
        float probability;
    };
    static float border_at(double share)
    {
        return static_cast<float>(share < 0.5 ? share : share - 1);
    }
    LargeVector<Cell> cells_;
};

/// A weight that is not 0 counts as this at least, among so many of which `largest` is one: 2⁻⁵⁰ of
/// all or more. Less, and the rounding of their running sum would leave it none: never drawn, it
/// would be missing from the mean (docs/theory.md §7).
MIS_INLINE double least_weight(double largest, std::size_t count)
{
    return largest * (0x1p-50 * static_cast<double>(count));
}
MIS_INLINE double with_a_share(double weight, double least)
{
    const double lifted = weight > least ? weight : least;
    return weight > 0 ? lifted : 0;
}

/// An index in proportion to weights that change from point to point: a running sum over storage of
/// the caller's.
class RunningSum {
public:
    /// weights: not negative, finite; few, as each that is not 0 gets a share. sums: of the same
    /// length, kept by reference.
    template <class T>
    MIS_INLINE static RunningSum over(std::span<const T> weights, std::span<double> sums)
    {
        double largest = 0, sum = 0;
        for (const T weight : weights) largest = std::max(largest, static_cast<double>(weight));
        const double least = least_weight(largest, weights.size());
        for (std::size_t i = 0; i < weights.size(); ++i)
            sums[i] = sum += with_a_share(static_cast<double>(weights[i]), least);
        return RunningSum(sums);
    }

    RunningSum() = default;
    /// sums: never fall, and stay where the weight is 0. Kept by reference.
    MIS_INLINE explicit RunningSum(std::span<const double> sums)
        : sums_(sums), inverse_total_(!sums.empty() && sums.back() > 0 ? 1 / sums.back() : 0)
    {
    }

    MIS_INLINE Choice choose(std::uint64_t bits) const
    {
        if (!(inverse_total_ > 0)) return {-1, 0};
        const auto light = static_cast<std::int32_t>(find(bits).index);
        return {light, probability(light)};
    }

    MIS_INLINE double probability(std::int32_t light) const
    {
        const auto i = static_cast<std::size_t>(light);
        return (sums_[i] - sum_before(i)) * inverse_total_;
    }

    /// One over the sum of all weights; 0 where they all are.
    MIS_INLINE double inverse_total() const { return inverse_total_; }

    /// Where the bits fall: an index, and how far into its weight.
    struct Place {
        std::size_t index;
        double rest;
    };
    /// Precondition: inverse_total() > 0.
    MIS_INLINE Place find(std::uint64_t bits) const
    {
        const double target = target_of(bits);
        // The first sum above the target; it never is that of a weight of 0.
        std::size_t first = 0, count = sums_.size();
        while (count > 1) {
            const std::size_t half = count / 2;
            first +=
                half * static_cast<std::size_t>(sums_[first + half - 1] <= target);  // no branch
            count -= half;
        }
        return {first, target - sum_before(first)};
    }

    /// put(i, choose(bits[i])) for all i. Few weights are compared with draws in lanes; L: of
    /// double.
    template <class L, class Put>
    MIS_INLINE void choose_many(std::span<const std::uint64_t> bits, const Put& put) const
    {
        constexpr std::size_t few = 12, at_once = 16;
        if (sums_.size() > few || bits.size() < at_once / 2 || !(inverse_total_ > 0)) {
            for (std::size_t i = 0; i < bits.size(); ++i) put(i, choose(bits[i]));
            return;
        }
        for (std::size_t begin = 0; begin < bits.size(); begin += at_once) {
            const std::size_t count = std::min(at_once, bits.size() - begin);
            std::array<double, at_once> target{}, light, share;  // NOLINT: filled below
            for (std::size_t i = 0; i < count; ++i) target[i] = target_of(bits[begin + i]);
            for (std::size_t i = 0; i < at_once; i += lane_count<L>)
                choose_in_lanes<L>(&target[i], &light[i], &share[i]);
            for (std::size_t i = 0; i < count; ++i)
                put(begin + i, Choice{static_cast<std::int32_t>(light[i]), share[i]});
        }
    }

private:
    /// The first sum above each target, and its probability.
    template <class L>
    MIS_INLINE void choose_in_lanes(const double* target, double* light, double* share) const
    {
        const L b = load_lanes<L>(target);
        L index(0.0), lower(0.0), upper(sums_[0]);
        for (std::size_t j = 0; j + 1 < sums_.size(); ++j) {
            const L sum(sums_[j]);
            const auto is_above = sum <= b;
            index = select(is_above, L(index + L(1.0)), index);
            lower = select(is_above, sum, lower);
            upper = select(is_above, L(sums_[j + 1]), upper);
        }
        store_lanes(light, index);
        store_lanes(share, L((upper - lower) * L(inverse_total_)));
    }

    /// In [0, total): of the bits, the first 52.
    MIS_INLINE double target_of(std::uint64_t bits) const
    {
        const double from_1 = std::bit_cast<double>(bits >> 12 | std::bit_cast<std::uint64_t>(1.0));
        return (from_1 - 1) * sums_.back();  // at most (1 − 2⁻⁵²) total, which is below it
    }
    MIS_INLINE double sum_before(std::size_t i) const
    {
        const std::size_t has_lower =
            i > 0 ? 1 : 0;  // by arithmetic: as a branch it is mispredicted
        return sums_[i - has_lower] * static_cast<double>(has_lower);
    }
    std::span<const double> sums_;
    double inverse_total_ = 0;
};

/// How many weights stand under one sum where there are many.
inline constexpr std::size_t block_size = 16;

/// The sum of a block of weights, in double.
template <class T> MIS_INLINE double sum_of_block(const T* weights)
{
    constexpr std::size_t quarter = block_size / 4;
    using Doubles = CompilerLanes<double, quarter>::Type;
    std::array<Doubles, 4> part;  // NOLINT: filled at once
    for (std::size_t k = 0; k < part.size(); ++k) {
        typename CompilerLanes<T, quarter>::Type some;  // NOLINT: filled at once
        std::memcpy(&some, weights + k * quarter, sizeof some);
        part[k] = __builtin_convertvector(some, Doubles);
    }
    const Doubles s = (part[0] + part[1]) + (part[2] + part[3]);
    return (s[0] + s[2]) + (s[1] + s[3]);
}

/// The place in a block that `rest` of its sum falls into; never one of weight 0. Precondition: the
/// sum is positive. Of what rounding leaves beyond the sum, the last place that counts.
template <class T> MIS_INLINE std::size_t place_in_block(const T* weights, double rest)
{
    constexpr double below = 1 - 0x1p-52;  // times a sum: less than it
    constexpr std::size_t quarters = 4;
    std::array<double, block_size / quarters> sum;  // NOLINT: filled at once
    for (std::size_t g = 0; g < sum.size(); ++g) {
        const T* w = weights + g * quarters;
        sum[g] =
            ((static_cast<double>(w[0]) + static_cast<double>(w[1])) + static_cast<double>(w[2])) +
            static_cast<double>(w[3]);
    }
    const double one = sum[0], two = one + sum[1], three = two + sum[2], all = three + sum[3];
    rest = std::min(rest, all * below);
    const std::size_t g = static_cast<std::size_t>(rest >= one) +
                          static_cast<std::size_t>(rest >= two) +
                          static_cast<std::size_t>(rest >= three);
    const std::array<double, quarters> before{0, one, two, three};
    rest = std::min(rest - before[g], sum[g] * below);
    const T* w = weights + g * quarters;
    const double first = static_cast<double>(w[0]), second = first + static_cast<double>(w[1]),
                 third = second + static_cast<double>(w[2]);
    return g * quarters + static_cast<std::size_t>(rest >= first) +
           static_cast<std::size_t>(rest >= second) + static_cast<std::size_t>(rest >= third);
}

}  // namespace mis
