#include "mis/engine/strata_spread.h"

#include "mis/sampling/discrete.h"

#include <algorithm>
#include <cmath>

namespace mis {

template <class S> StrataParts<S>& StrataSpread<S>::room(std::size_t places, int draws)
{
    rest_.resize(places);
    block_sums_.resize(places / block_size);
    heavy_place_.resize(std::min(static_cast<std::size_t>(draws / 2), places));
    heavy_spread_.resize(heavy_place_.size());
    parts_ = {.rest = rest_,
              .block_sums = block_sums_,
              .heavy_place = heavy_place_,
              .heavy_spread = heavy_spread_};
    return parts_;
}

template <class S> void StrataSpread<S>::spread(int draws, const std::array<double, 2>& offset)
{
    draws_.clear();
    const int heavy = static_cast<int>(parts_.heavy);
    const int of_rest = draws_of_rest(draws - heavy);
    rest_draws_ = of_rest > 0 ? of_rest / parts_.rest_sum : 0;
    if (heavy > 0) draw_heavy(draws - heavy - of_rest, offset[0]);
    if (of_rest > 0) draw_rest(of_rest, offset[1]);
}

/// In proportion to the deviations of both parts. That of one draw from the rest, where p ∝ P √v,
/// is √((Σ P √v)² − (Σ P v)²).
template <class S> int StrataSpread<S>::draws_of_rest(int free) const
{
    const double sum = parts_.rest_sum;
    if (!(sum > 0)) return 0;
    double heavy = 0;
    for (std::size_t i = 0; i < parts_.heavy; ++i) heavy += static_cast<double>(heavy_spread_[i]);
    const double seen = std::min(parts_.rest_seen / sum, 1.0);
    const double rest = sum * std::sqrt(1 - seen * seen + least_variance_of_seen);
    return std::clamp(static_cast<int>(std::lround(free * (rest / (rest + heavy)))), 1, free);
}

/// One draw each, and `extra` more in proportion to their deviations, systematically.
template <class S> void StrataSpread<S>::draw_heavy(int extra, double offset)
{
    double total = 0, sum = 0;
    for (std::size_t i = 0; i < parts_.heavy; ++i) total += static_cast<double>(heavy_spread_[i]);
    heavy_draws_.resize(parts_.heavy);
    for (std::size_t i = 0, before = 0; i < parts_.heavy; ++i) {
        sum += static_cast<double>(heavy_spread_[i]);
        const auto most = static_cast<std::size_t>(extra);
        const bool is_last = i + 1 == parts_.heavy;
        const std::size_t up_to =
            is_last ? most
                    : std::clamp(static_cast<std::size_t>(extra * (sum / total) + offset), before,
                                 most);
        const int draws = 1 + static_cast<int>(up_to - before);
        before = up_to;
        heavy_draws_[i] = draws;
        for (int d = 0; d < draws; ++d)
            draws_.push_back({static_cast<LightIndex>(heavy_place_[i]), static_cast<S>(draws),
                              heavy_place_[i], static_cast<std::uint32_t>(d)});
    }
}

/// Systematically, in the order of places.
template <class S> void StrataSpread<S>::draw_rest(int draws, double offset)
{
    const double step = parts_.rest_sum / draws;
    double before = 0;
    std::size_t last = 0;  // block that can be drawn from
    int drawn = 0;
    const auto put = [&](std::size_t block, double rest) {
        const std::size_t place =
            block * block_size + place_in_block(&rest_[block * block_size], rest);
        draws_.push_back({static_cast<LightIndex>(place),
                          static_cast<S>(static_cast<double>(rest_[place]) * rest_draws_),
                          rest_stratum, static_cast<std::uint32_t>(drawn++)});
    };
    const auto target = [&] { return (drawn + offset) * step; };
    for (std::size_t b = 0; b < block_sums_.size() && drawn < draws; ++b) {
        if (!(block_sums_[b] > 0)) continue;
        last = b;
        while (drawn < draws && target() < before + block_sums_[b]) put(b, target() - before);
        before += block_sums_[b];
    }
    while (drawn < draws) put(last, block_sums_[last]);  // that rounding leaves beyond the sum
}

template <class S> void StrataSpread<S>::write_expected(std::span<S> expected) const
{
    for (std::size_t k = 0; k < expected.size(); ++k)
        expected[k] = static_cast<S>(static_cast<double>(rest_[k]) * rest_draws_);
    for (std::size_t i = 0; i < parts_.heavy; ++i)
        expected[heavy_place_[i]] = static_cast<S>(heavy_draws_[i]);
}

template class StrataSpread<float>;
template class StrataSpread<double>;

}  // namespace mis
