#pragma once

#include "mis/policy/seen_light.h"
#include "mis/sampling/discrete.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace mis {

/// A point and the lights that it sees.
template <class S> struct SeenLights {
    ChoicePoint<S> point;    ///< as policies see it
    LightColumns<S> lights;  ///< all of them
};

namespace detail {

/// The weights of a block of lights; of what is beyond the last light 0.
template <class T, class Weight>
MIS_INLINE void weigh_block(const Weight& weight, const Vec3<T>& x, const Vec3<T>& n,
                            const LightColumns<Scalar<T>>& lights, std::size_t block,
                            Scalar<T>* weights)
{
    const std::size_t first = block * block_size;
    for (std::size_t k = 0; k < block_size; k += lane_count<T>)
        store_lanes(&weights[k], T(weight(seen_light<T>(lights, first + k, x), n)));
    for (std::size_t k = lights.count - first; k < block_size; ++k) weights[k] = 0;
}

/// The same for one block, by the name of the weights.
template <class T, class Weights>
MIS_OWN_COPY void weigh_again(const SeenLights<Scalar<T>>& seen, std::size_t block,
                              Scalar<T>* weights)
{
    Weights::template visit_weight<T>(
        seen.point, [&](const auto& weight) __attribute__((always_inline)) {
            weigh_block<T>(weight, in_lanes<T>(seen.point.x), in_lanes<T>(seen.point.n),
                           seen.lights, block, weights);
        });
}

}  // namespace detail

/// The table of a policy whose weight is a formula per light: of a few lights their running sum; of
/// more, the running sum of blocks of 16. The weights of a block are kept; of many lights, which no
/// cache would hold, they are formed anew when one is asked for, by the same lanes, so to the last
/// bit. Weights: the policy, for its visit_weight<T>(point, use), which calls use(weight);
/// weight(seen light, n) ≥ 0 and finite; its unit is free.
template <class T, class Weights> class WeightTable {
    using S = Scalar<T>;

public:
    /// Up to so many lights each has a sum of its own.
    static constexpr std::size_t most_single = 32;
    /// Up to so many the weights are kept.
    static constexpr std::size_t most_kept = std::size_t{1} << 14;

    /// A table to fill: from the first block on, in as many steps as one likes, of some blocks
    /// each.
    MIS_INLINE static WeightTable begin(const ChoicePoint<S>& point, const LightColumns<S>& lights,
                                        Scratch& scratch)
    {
        WeightTable table;
        const std::size_t count = lights.count;
        if (count <= most_single) {
            table.sums_ = scratch.take<double>(count).data();
        } else {
            table.sums_ = scratch.take<double>(blocks_of(count)).data();
            if (count <= most_kept) {
                table.weights_ = scratch.take<S>(blocks_of(count) * block_size).data();
            } else {
                table.seen_ = scratch.take<Seen>(1).data();
                *table.seen_ = {point, lights};
            }
        }
        return table;
    }
    /// Fills in blocks [first, end); those before are filled in.
    MIS_INLINE void fill(const ChoicePoint<S>& point, const LightColumns<S>& lights,
                         std::size_t first, std::size_t end)
    {
        double sum = first > 0 ? sums_[first - 1] : 0;
        const LightColumns<S> columns = lights;  // nothing else can reach it: it stays in registers
        const Vec3<T> x = in_lanes<T>(point.x), n = in_lanes<T>(point.n);
        Weights::template visit_weight<T>(
            point, [&](const auto& weight) __attribute__((always_inline)) {
                constexpr std::size_t some =
                    8;  // blocks at a time: what is stored now is read later
                alignas(64) std::array<S, some * block_size> room;  // NOLINT: filled by weigh_block
                for (std::size_t b = first; b < end; b += some) {
                    const std::size_t count = std::min(some, end - b);
                    S* weights = weights_ != nullptr ? weights_ + b * block_size : room.data();
                    for (std::size_t k = 0; k < count; ++k)
                        detail::weigh_block<T>(weight, x, n, columns, b + k,
                                               weights + k * block_size);
                    for (std::size_t k = 0; k < count; ++k)
                        sums_[b + k] = sum += sum_of_block(weights + k * block_size);
                }
            });
    }
    /// The same where there are so many lights that no weights are kept.
    MIS_INLINE void fill_more(std::size_t first, std::size_t end)
    {
        fill(seen_->point, seen_->lights, first, end);
    }
    /// All of it, in one step.
    MIS_INLINE static WeightTable over(const ChoicePoint<S>& point, const LightColumns<S>& lights,
                                       Scratch& scratch)
    {
        WeightTable table = begin(point, lights, scratch);
        if (lights.count <= most_single) table.fill_few(point, lights);
        else table.fill(point, lights, 0, blocks_of(lights.count));
        table.end(lights);
        return table;
    }
    /// To be called when all is filled in.
    MIS_INLINE void end(const LightColumns<S>& lights)
    {
        const std::size_t count = lights.count;
        total_ = RunningSum(
            std::span<const double>(sums_, count <= most_single ? count : blocks_of(count)));
    }

    /// A light by 64 random bits; no_light and 0 where all weights are 0.
    MIS_INLINE Choice choose(std::uint64_t bits) const
    {
        if (is_of_few()) return total_.choose(bits);
        if (!(total_.inverse_total() > 0)) return {no_light, 0};
        const auto [block, rest] = total_.find(bits);
        std::array<S, block_size> room;  // NOLINT: filled as it is needed
        const S* weights = weights_of(block, room);
        const std::size_t k = place_in_block(weights, rest);
        return {static_cast<LightIndex>(block * block_size + k),
                static_cast<double>(weights[k]) * total_.inverse_total()};
    }
    /// put(i, choose(bits[i])) for all i; L: lanes of double.
    template <class L, class Put>
    MIS_INLINE void choose_many(std::span<const std::uint64_t> bits, const Put& put) const
    {
        if (is_of_few()) return total_.template choose_many<L>(bits, put);
        for (std::size_t i = 0; i < bits.size(); ++i) put(i, choose(bits[i]));
    }
    /// How likely a light is chosen.
    MIS_INLINE double probability(LightIndex light) const
    {
        if (is_of_few()) return total_.probability(light);
        const auto j = static_cast<std::size_t>(light);
        std::array<S, block_size> room;  // NOLINT: filled as it is needed
        return static_cast<double>(weights_of(j / block_size, room)[j % block_size]) *
               total_.inverse_total();
    }

    /// How many blocks so many lights make.
    static constexpr std::size_t blocks_of(std::size_t lights)
    {
        return (lights + block_size - 1) / block_size;
    }
    /// What it takes of the scratch, for float or double weights.
    static constexpr std::size_t bytes(std::size_t lights)
    {
        if (lights <= most_single) return Scratch::bytes_for<double>(lights);
        const std::size_t blocks = blocks_of(lights);
        return Scratch::bytes_for<double>(blocks) +
               (lights <= most_kept ? Scratch::bytes_for<double>(blocks * block_size)
                                    : Scratch::bytes_for<SeenLights<S>>(1));
    }

private:
    using Seen = SeenLights<S>;

    MIS_INLINE bool is_of_few() const { return weights_ == nullptr && seen_ == nullptr; }

    MIS_INLINE void fill_few(const ChoicePoint<S>& point, const LightColumns<S>& lights)
    {
        Weights::template visit_weight<T>(
            point, [&](const auto& weight) __attribute__((always_inline)) {
                alignas(64) std::array<S, most_single> weights;  // NOLINT: filled as it is read
                for (std::size_t b = 0; b * block_size < lights.count; ++b)
                    detail::weigh_block<T>(weight, in_lanes<T>(point.x), in_lanes<T>(point.n),
                                           lights, b, &weights[b * block_size]);
                RunningSum::over(std::span<const S>(weights).first(lights.count),
                                 std::span<double>(sums_, lights.count));
            });
    }

    MIS_INLINE const S* weights_of(std::size_t block, std::array<S, block_size>& room) const
    {
        if (weights_ != nullptr) return weights_ + block * block_size;
        detail::weigh_again<T, Weights>(*seen_, block, room.data());
        return room.data();
    }

    RunningSum total_;        ///< of lights, or of blocks
    double* sums_ = nullptr;  ///< that it stands on
    S* weights_ = nullptr;    ///< kept
    Seen* seen_ = nullptr;    ///< nullptr where they are
};

/// What the table of a policy takes of the scratch whose weight is a formula per light.
template <class Weights> constexpr std::size_t weight_table_bytes(std::size_t lights)
{
    return WeightTable<double, Weights>::bytes(lights);
}

}  // namespace mis
