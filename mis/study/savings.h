#pragma once

#include "mis/engine/lit_scene.h"
#include "mis/math/stop_token.h"

#include <vector>

namespace mis {

/// Over how many tiles savings are measured: some milliseconds' work.
inline constexpr std::size_t most_tiles_of_savings = 12;

/// At most `most` tiles of a buffer, evenly spread, with their points.
GBuffer spread_tiles(const GBuffer& shading, std::size_t most);

/// Measures what leaving each effect out of the tiles' plans saves a sample of uniform/power, by a
/// short run over these tiles with and without, in turn; and writes it down. An effect that the
/// whole scene does not call for stays unmeasured (NaN), as one that `auto` does not look at.
/// Throws Stopped, and leaves those unmeasured that had not had their turn.
void measure_savings(const LitScene& scene, const GBuffer& shading,
                     std::vector<EffectPlan>& effects, const StopToken& stop = {});

}  // namespace mis
