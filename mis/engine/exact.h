#pragma once

#include "mis/engine/render.h"
#include "mis/strategy/strategy.h"

namespace mis {

/// Has direct light a closed form at every point of a tile? So it is on a Lambertian material where
/// the tile's plan proves that nothing stands before any light.
bool has_closed_form(const LitScene& scene, const Tile& tile);

/// Has it at every point of the first `tiles` tiles? By all that can be proved, whatever effects
/// are simulated, and however many samples are to come.
bool has_closed_form(const LitScene& scene, const GBuffer& shading, std::size_t tiles,
                     const AnyExecutor& executor);

/// Is every sample of a strategy the closed form, whatever it draws, wherever there is one? So it
/// is of light draws by the irradiance's own density, if each light is drawn, or is in proportion
/// to its irradiance, or is the only one. Of luminance, which all figures are of: with
/// `irradiance`, lights or materials are grey, or lights of one colour. docs/theory.md §3.
bool gives_closed_form(const Scene& scene, const Strategy& strategy);

/// Radiance towards the viewer at a point of such a tile, in double: the sum over the lights of f L
/// E, the horizon's cut included (math/irradiance.h; docs/theory.md, eqs. 48 to 51).
Vec3<double> exact_radiance(const LitScene& scene, const Tile& tile, const ShadingPoint& point);

/// Of some points, how many stand in tiles that have a closed form; dark points are 0, and count.
struct ExactShare {
    std::size_t exact = 0, points = 0, exact_tiles = 0, tiles = 0;
    bool is_all() const { return exact == points; }
};
ExactShare exact_share(const LitScene& scene, const GBuffer& shading);

/// Every shading point of a band by its closed form, which they all must have.
void light_exactly(const LitScene& scene, Band& band, const AnyExecutor& executor);

}  // namespace mis
