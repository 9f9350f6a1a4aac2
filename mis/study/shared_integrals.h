#pragma once

#include "mis/stats/centred_sums.h"
#include "mis/study/shared_directions.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace mis {

/// What all rounds so far say of one strategy at one point.
struct SharedSums {
    ReplicateSquares variance;  ///< over the rounds that count
    double last = 0;            ///< of them: the last take()'s alone
    double with_luminance = 0;  ///< Σ of each round's, times the luminance by its directions
    /// Of the light draws, over all rounds: Σ of ∫y p and ∫p. Where every light is drawn, ∫p counts
    /// by how much of the light LightMixture::guess() expects there.
    double light_mean = 0, light_mass = 0;
    double rounds = 0;

    /// What the next round's light draws are centred by: it knows nothing of that round. ∫p is 1
    /// where it is drawn at all: what met hardly any of it so far tells no mean by it.
    double center() const
    {
        constexpr double hardly = 0.1;
        return rounds > 0 ? light_mean / std::max(light_mass, hardly * rounds) : 0;
    }
};

/// The same of one light's own draws, of a strategy that draws every light.
struct LightSums {
    float mean = 0, mass = 0;

    /// guessed: where it was not drawn yet.
    double center(double guessed) const
    {
        if (!(mass > 0)) return guessed;
        const double known = static_cast<double>(mean) / static_cast<double>(mass);
        return std::isfinite(known) ? known : guessed;
    }
};

/// One round's integrals, of all strategies at one point.
class SharedIntegrals {
public:
    /// Keeps a reference to the plan.
    SharedIntegrals(const SharedPlan& plan, std::size_t lights);

    /// Of the directions of a round. sums: [strategy], lights: [strategy that draws every light]
    /// [light] or empty; both take the round in. counts: the round's variances count.
    void take(const DirectionSet& set, std::span<SharedSums> sums, std::span<LightSums> lights,
              bool counts);

    /// ∫F, from all directions.
    double mean() const;
    /// [strategy]: ∫F where the strategy never draws.
    std::span<const double> missed() const { return missed_; }

private:
    struct Pair {
        CentredSums light, bsdf;
    };
    void begin(const LightMixture& mixture, std::span<const SharedSums> sums);
    void find_densities(const DirectionSet& set, const SharedDirection& d);
    void add(std::size_t s, const DirectionSet& set, const SharedDirection& d);
    void add_light_draws(std::size_t s, const DirectionSet& set, const SharedDirection& d,
                         double value);
    /// Sums of each strategy that draws every light, of this light's own draws.
    std::span<CentredSums> sums_of(const LightMixture& mixture, LightIndex light);
    void add_rounds_light_sums(std::span<LightSums> lights) const;
    double variance_of(std::size_t s) const;

    const SharedPlan* plan_;
    std::size_t lights_;
    std::span<LightSums> light_sums_;
    std::vector<double> center_;  ///< [strategy that draws every light], over the guess
    std::vector<double> seen_mean_, seen_mass_;  ///< the same: what the next one is made of
    std::vector<Pair> pairs_;                    ///< [strategy]
    std::vector<double> density_;                ///< [density of the plan]
    std::vector<double> missed_;                 ///< [strategy]
    CentredSums all_;
    double over_density_ = 0, over_marginal_ = 0;  ///< one over D of the direction at hand
    /// Lights that the round has met, and each one's place among them.
    std::vector<LightIndex> met_;
    std::vector<std::int32_t> place_;    ///< [light]; −1: not met
    std::vector<CentredSums> met_sums_;  ///< [place][strategy that draws every light]
};

}  // namespace mis
