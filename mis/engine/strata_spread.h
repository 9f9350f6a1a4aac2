#pragma once

#include "mis/engine/strata_parts.h"
#include "mis/scene/light.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace mis {

/// One draw towards a light in a round.
template <class S> struct StratumDraw {
    LightIndex place;  ///< of the tables
    /// Draws of this light in the round: of a heavy light those that there are, of another those
    /// that are expected.
    S expected;
    std::uint32_t stratum;  ///< the place of a heavy light, or rest_stratum
    std::uint32_t number;   ///< within the stratum, from 0
};

/// The stratum of all lights that have none of their own.
inline constexpr std::uint32_t rest_stratum = 0xFFFF'FFFFU;

/// Spreads a round's draws over the lights of one point. Keeps its room from one to the next.
template <class S> class StrataSpread {
public:
    /// Room for so many places, a multiple of 16, and a round of so many draws; to be filled in.
    StrataParts<S>& room(std::size_t places, int draws);

    /// Spreads so many draws by the parts: offset, two numbers in [0, 1), of the heavy lights'
    /// extra draws, and of the rest's. None where all shares are 0.
    void spread(int draws, const std::array<double, 2>& offset);

    /// Draws of one stratum stand together.
    std::span<const StratumDraw<S>> draws() const { return draws_; }

    /// Expected draws of every light, [place], for those who meet a light otherwise.
    void write_expected(std::span<S> expected) const;

private:
    int draws_of_rest(int free) const;
    void draw_heavy(int extra, double offset);
    void draw_rest(int draws, double offset);

    StrataParts<S> parts_;
    std::vector<S> rest_, heavy_spread_;
    std::vector<double> block_sums_;
    std::vector<std::uint32_t> heavy_place_;
    std::vector<int> heavy_draws_;  ///< of the heavy lights, in their order
    double rest_draws_ = 0;         ///< over Σ rest
    std::vector<StratumDraw<S>> draws_;
};

extern template class StrataSpread<float>;
extern template class StrataSpread<double>;

}  // namespace mis
