#pragma once

#include "mis/effects/tile_plan.h"
#include "mis/engine/batch.h"
#include "mis/engine/light_order.h"
#include "mis/math/stop_token.h"
#include "mis/policy/light_choice.h"
#include "mis/sampling/number_source.h"
#include "mis/scene/shading_point.h"
#include "mis/trace/lights.h"
#include "mis/trace/visibility.h"

namespace mis {

/// Up to so many lights, all are screened by lanes of samples before the hierarchy is asked.
inline constexpr std::size_t most_screened_lights = 32;

/// What the stages of one tile read. Plain values and references; nothing here changes while a tile
/// runs.
template <class T> struct TileJob {
    std::span<const ShadingPoint> points;  ///< of the tile
    std::uint32_t picture_width = 0;       ///< by which ids are pixels; 0 without a camera
    const Lights* lights = nullptr;
    const LightOrder* order = nullptr;  ///< of tables and columns; nullptr: the scene's
    const LightHierarchy* hierarchy = nullptr;
    const SurfaceTracer* surfaces = nullptr;  ///< nullptr where none can occlude
    std::span<const std::uint8_t> proofs;     ///< [light] LightProof bits; empty: nothing is proved
    const Blockers* blockers = nullptr;       ///< of the tile; nullptr: the hierarchy is asked
    Vec3<double> origin{0};                   ///< of the columns
    LightColumns<T> columns;       ///< for policies that look at all lights, and for screening
    const void* policy = nullptr;  ///< a type of the registry, as is bsdf
    const void* bsdf = nullptr;
    const void* lobe = nullptr;  ///< of the BSDF alone, of its type; nullptr where it has none
    int bsdf_type = -1;          ///< bsdf_number() of its name
    double radiance_scale = 1;   ///< of radiance and contributions in the batch: radiance_scale.h
    double radiance_unit = 1;    ///< what undoes it
    NumberSource numbers;
    T light_count = 1,
      bsdf_count = 1;  ///< n_i of the multi-sample model; c_i of the one-sample model
    bool draws_every_light = false;
    std::uint32_t draws_per_light = 1;  ///< or per sample, where the policy draws one
    std::uint32_t bsdf_draws = 1;       ///< per sample
    const StopToken* stop = nullptr;    ///< asked between batches and draws; nullptr: never

    /// The record of a light.
    MIS_INLINE const Light& light(LightIndex j) const
    {
        return (*lights)[static_cast<std::size_t>(j)];
    }
    /// Is that proved of a light?
    MIS_INLINE bool knows(LightIndex light, LightProof proof) const
    {
        return !proofs.empty() && light >= 0 &&
               (proofs[static_cast<std::size_t>(light)] & proof) != 0;
    }
    /// The light at a place of the tables, and back.
    MIS_INLINE LightIndex light_at(LightIndex place) const
    {
        return order == nullptr || place < 0 ? place
                                             : order->light_at[static_cast<std::size_t>(place)];
    }
    MIS_INLINE LightIndex place_of(LightIndex light) const
    {
        return order == nullptr || light < 0 ? light
                                             : order->place_of[static_cast<std::size_t>(light)];
    }
};

/// One step of a pipeline: reads and writes columns of a batch, and nothing else. A stage is a loop
/// over rows that calls a formula written once; there is one per policy, technique, BSDF and
/// heuristic, for each number type and instruction set.
template <class T> using Stage = void (*)(const TileJob<T>&, Batch<T>&);

/// Fills the tables of the batch's points [first, batch.points), from the scratch.
template <class T>
using PrepareStage = void (*)(const TileJob<T>&, Batch<T>&, std::size_t first, Scratch&);

}  // namespace mis
