#pragma once

#include "mis/engine/rows.h"
#include "mis/engine/stages_numbers.h"
#include "mis/engine/strata_parts.h"
#include "mis/policy/product.h"
#include "mis/sampling/discrete.h"

#include <limits>

namespace mis {
inline namespace MIS_ISA {

// What `strata` does over all lights of a point, in lanes of lights.

/// Of a light in the rest, not less than this is taken as seen, so that it may yet be found.
inline constexpr double least_seen = 5e-4;

/// Shares of all lights in what a point would reflect, were nothing shaded (`product`); Σ = 1, or
/// all 0. shares: the lights' number, padded to a multiple of 16.
template <class V, class T>
void find_shares(const TileJob<T>& job, const ShadingPoint& shading_point, std::span<T> shares)
{
    const ChoicePoint<T> point = choice_point(job, shading_point);
    T* out = shares.data();
    const std::size_t size = shares.size();
    const LightColumns<T> columns =
        job.columns;  // nothing else can reach it: it stays in registers
    const Vec3<V> x = in_lanes<V>(point.x), n = in_lanes<V>(point.n);
    double sum = 0;
    ProductPolicy::visit_weight<V>(
        point, [&](const auto& weight) __attribute__((always_inline)) {
            for (std::size_t k = 0; k < size; k += block_size) {
                detail::weigh_block<V>(weight, x, n, columns, k / block_size, out + k);
                sum += sum_of_block(out + k);
            }
        });
    const double inverse = sum > 0 ? 1 / sum : 0;
    for (std::size_t k = 0; k < size; ++k)
        out[k] = static_cast<T>(static_cast<double>(out[k]) * inverse);
}

/// Posterior means of being seen, of lights [k, k + lane_count).
template <class V, class T>
MIS_INLINE V seen_at(const StrataKnowledge<T>& known, std::size_t k, const V& drawn)
{
    return seen_within<V>(load_lanes<V>(&known.counts.seen[k]), drawn,
                          load_lanes<V>(&known.block[k]));
}

/// Lights whose P √v is above this are heavy: each would be drawn at least twice, were it drawn in
/// proportion to that beside those that are not heavy. P √v is left in `root`. At most half as many
/// as there are draws, so that half of them are free.
template <class V, class T>
MIS_INLINE T find_threshold(const StrataKnowledge<T>& known, int draws, T* root)
{
    using std::sqrt;
    const std::size_t size = known.share.size();
    const V zero = number<V>(0), one = number<V>(1);
    V sum = zero;
    for (std::size_t k = 0; k < size; k += lane_count<V>) {
        const V seen = seen_at<V>(known, k, V(load_lanes<V>(&known.counts.drawn[k])));
        const V value = load_lanes<V>(&known.share[k]) * sqrt(seen);
        store_lanes(root + k, value);
        sum += value;
    }
    T threshold = std::numeric_limits<T>::infinity();
    const int most = draws / 2;
    T rest = sum_of_lanes(sum);
    for (int count = 0; most > 0;) {
        const T bound = 2 * rest / static_cast<T>(draws);
        V left = zero, above = zero;
        for (std::size_t k = 0; k < size; k += lane_count<V>) {
            const V value = load_lanes<V>(root + k);
            const auto is_heavy = value > V(bound);
            left += select(is_heavy, zero, value);
            above += select(is_heavy, one, zero);
        }
        const int next = static_cast<int>(sum_of_lanes(above));
        if (next > most) break;
        threshold = bound;
        if (next == count) break;
        count = next;
        rest = sum_of_lanes(left);
    }
    return threshold;
}

/// Parts a point's lights for a round of so many draws.
template <class V, class T>
void part_lights(const StrataKnowledge<T>& known, int draws, StrataParts<T>& parts)
{
    using std::sqrt;
    T* rest = parts.rest.data();
    const V threshold(find_threshold<V>(known, draws, rest));
    const V zero = number<V>(0), one = number<V>(1);
    V seen_sum = zero;
    parts.heavy = 0;
    parts.rest_sum = 0;
    for (std::size_t b = 0; b < known.share.size(); b += block_size) {
        for (std::size_t k = b; k < b + block_size; k += lane_count<V>) {
            const V share = load_lanes<V>(&known.share[k]);
            const V drawn = load_lanes<V>(&known.counts.drawn[k]);
            const V seen = seen_at<V>(known, k, drawn);
            const auto is_heavy = load_lanes<V>(rest + k) > threshold;
            const V root = share * sqrt(max_of(seen, number<V>(least_seen)));
            store_lanes(rest + k, V(select(is_heavy, zero, root)));
            seen_sum += select(is_heavy, zero, V(share * seen));
            if (!any_lane(is_heavy)) continue;
            const V variance = seen * (one - seen) + number<V>(doubt_of_seen) / (drawn + one) +
                               number<V>(least_variance_of_seen);
            alignas(64) T spread[lane_count<V>];  // NOLINT: filled at once
            store_lanes(&spread[0], V(select(is_heavy, V(share * sqrt(variance)), zero)));
            for (std::size_t i = 0; i < lane_count<V>; ++i) {
                if (!(spread[i] > 0)) continue;
                parts.heavy_place[parts.heavy] = static_cast<std::uint32_t>(k + i);
                parts.heavy_spread[parts.heavy++] = spread[i];
            }
        }
        parts.rest_sum += parts.block_sums[b / block_size] = sum_of_block(rest + b);
    }
    parts.rest_seen = static_cast<double>(sum_of_lanes(seen_sum));
}

/// Posterior means of a tile, [place].
template <class V, class T> void learn_tile(const SeenCounts<T>& counts, std::span<T> means)
{
    for (std::size_t k = 0; k < means.size(); k += lane_count<V>)
        store_lanes(&means[k], seen_in_tile<V>(load_lanes<V>(&counts.seen[k]),
                                               load_lanes<V>(&counts.drawn[k])));
}

/// The same of a block, by those of its tile.
template <class V, class T>
void learn_block(const SeenCounts<T>& counts, std::span<const T> tile, std::span<T> means)
{
    for (std::size_t k = 0; k < means.size(); k += lane_count<V>)
        store_lanes(&means[k],
                    seen_within<V>(load_lanes<V>(&counts.seen[k]), load_lanes<V>(&counts.drawn[k]),
                                   load_lanes<V>(&tile[k])));
}

/// Each bit of a word depends on all bits. Source: Appleby 2011, MurmurHash3's fmix32.
MIS_INLINE std::uint32_t mixed(std::uint32_t word)
{
    word = (word ^ word >> 16) * 0x85eb'ca6bu;
    word = (word ^ word >> 13) * 0xc2b2'ae35u;
    return word ^ word >> 16;
}

/// stratum, number, keys → u, v: of every row its point in the Sobol' sequence of its stratum,
/// which is scrambled afresh in each round.
template <class T> void strata_numbers(StrataColumns& of, Batch<T>& batch)
{
    Column<std::uint32_t> u, v;  // NOLINT: filled as far as they are read
    const auto rows = static_cast<std::size_t>(batch.rows);
    for (std::size_t i = 0; i < rows; ++i) {
        const std::uint32_t stratum = of.stratum[i] * 0x9E37'79B9u;
        of.key_u[i] = mixed(of.key_u[i] + stratum), of.key_v[i] = mixed(of.key_v[i] ^ stratum);
    }
    sobol_words<Dimension::bsdf_u>(batch.rows, of.number, of.key_u, u);
    sobol_words<Dimension::bsdf_v>(batch.rows, of.number, of.key_v, v);
    for (std::size_t i = 0; i < rows; ++i)
        batch.u[i] = unit_number<T>(u[i]), batch.v[i] = unit_number<T>(v[i]);
}

}  // namespace MIS_ISA
}  // namespace mis
