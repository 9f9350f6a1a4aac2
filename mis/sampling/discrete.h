#pragma once

#include "mis/math/lanes.h"
#include "mis/math/large_vector.h"

#include <array>
#include <cstdint>
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

/// An index in proportion to weights that change from point to point: a running sum over storage of
/// the caller's.
class RunningSum {
public:
    /// weights: not negative, finite; kept by reference, as `sums` is, of the same length.
    template <class T>
    MIS_INLINE static RunningSum over(std::span<const T> weights, std::span<double> sums)
    {
        // Of many weights the four quarters at a time, which do not wait for one another's sums;
        // then each goes on from where the one before ended. Sums never fall, and stay where the
        // weight is 0.
        constexpr std::size_t parts = 4;
        const std::size_t part = weights.size() < 64 ? 0 : weights.size() / parts;
        std::array<double, parts> part_sum{};
        for (std::size_t i = 0; i < part; ++i)
            for (std::size_t k = 0; k < parts; ++k)
                sums[k * part + i] = part_sum[k] += static_cast<double>(weights[k * part + i]);
        double sum = part_sum[0];
        for (std::size_t k = 1; k < parts; ++k) {
            for (double& s : sums.subspan(k * part, part)) s += sum;
            sum += part_sum[k];
        }
        for (std::size_t i = parts * part; i < weights.size(); ++i)
            sums[i] = sum += static_cast<double>(weights[i]);
        return RunningSum(sums);
    }

    MIS_INLINE Choice choose(std::uint64_t bits) const
    {
        if (!(inverse_total_ > 0)) return {-1, 0};
        // Below the total even when the product rounds up to it.
        const double target = static_cast<double>(static_cast<std::int64_t>(bits >> 11)) *
                              (0x1p-53 * (1 - 0x1p-52)) * sums_.back();
        // The first sum above the target; it never is that of a weight of 0.
        std::size_t first = 0, count = sums_.size();
        while (count > 1) {
            const std::size_t half = count / 2;
            first +=
                half * static_cast<std::size_t>(sums_[first + half - 1] <= target);  // no branch
            count -= half;
        }
        const auto light = static_cast<std::int32_t>(first);
        return {light, probability(light)};
    }

    MIS_INLINE double probability(std::int32_t light) const
    {
        const auto i = static_cast<std::size_t>(light);
        const std::size_t has_lower =
            i > 0 ? 1 : 0;  // by arithmetic: as a branch it is mispredicted
        return (sums_[i] - sums_[i - has_lower] * static_cast<double>(has_lower)) * inverse_total_;
    }

    RunningSum() = default;

private:
    explicit RunningSum(std::span<const double> sums)
        : sums_(sums), inverse_total_(!sums.empty() && sums.back() > 0 ? 1 / sums.back() : 0)
    {
    }
    std::span<const double> sums_;
    double inverse_total_ = 0;
};

}  // namespace mis
