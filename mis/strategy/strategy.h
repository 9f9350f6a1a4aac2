#pragma once

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mis {

/// multi: every technique draws, each draw weighed (Veach 1997, §9.2.1).
/// one_sample: one technique is drawn, with probability ½ each (§9.2.4). strata: light draws in
/// rounds that learn from those before, beside BSDF draws (docs/theory.md §26).
enum class Model { multi, one_sample, strata };

/// What is ranked: policy + technique + heuristic + model + counts, as data (docs: design of a
/// strategy's name). A strategy that chooses no light ("brdf", "cosine", "hemisphere") has an empty
/// policy and heuristic.
struct Strategy {
    std::string policy;     ///< of the registry
    std::string heuristic;  ///< "light" for a light draw alone
    std::string technique =
        "cone";  ///< of the light draw; or the whole strategy where no light is chosen
    Model model = Model::multi;  ///< §9.2.1 or §9.2.4
    std::array<int, 2> counts{
        1, 1};  ///< light draws (for each light, with `all`) and BSDF draws per sample

    /// Does it draw towards lights at all?
    bool chooses_light() const { return !policy.empty(); }
    /// Are all members equal?
    bool operator==(const Strategy&) const = default;
};

/// The name of the strategy of rounds, which stands alone; with its light draws per point,
/// "strata@64".
inline constexpr std::string_view strata_name = "strata";

/// On materials with a lobe, a round of so many light draws has so many draws of the lobe: a
/// quarter. On the shipped scenes, variance × time hardly changes from an eighth to one each.
constexpr int lobe_draws(int light_draws) { return (light_draws + 3) / 4; }

/// The most lights for each of which `strata` keeps what was seen of it.
inline constexpr std::size_t most_strata_lights = 1024;

/// What is wrong with `strata` on a scene of so many.
std::string too_many_lights(const Strategy& strata, std::size_t lights);

/// The most light draws of `strata` at a point: 256 points count theirs in a float.
inline constexpr int most_strata_draws = 65536;

/// That strategy, of so many light draws per point. 0: as many as it is asked for.
Strategy strata(int draws);

/// How many samples of it only come together, and are one observation: all of `strata`'s; else 1.
int samples_together(const Strategy& strategy);

/// A strategy that has no meaning, or a name that is not known. what() says which, why, and what is
/// allowed.
struct StrategyError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// "solid-angle/power", "power/balance/union", "irradiance/balance@4+1": what is default is left
/// out.
std::string name_of(const Strategy& strategy);

/// The strategy of that name. Throws StrategyError.
Strategy parse_strategy(std::string_view name);

/// The same where each sample must stand by itself: `strata` is refused.
Strategy parse_sample_strategy(std::string_view name);

/// `strategy`, if it has a meaning. Throws StrategyError with the reason if not.
Strategy checked(Strategy strategy);

}  // namespace mis
