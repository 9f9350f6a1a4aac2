#pragma once

#include "mis/effects/effects.h"
#include "mis/engine/kernels.h"

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

namespace mis {

/// What a stage spends its time on; the report's "where the time goes".
enum class StageKind : std::uint8_t {
    prepare,
    rows,
    numbers,
    choose,
    draw,
    bsdf,
    meet,
    weigh,
    light_occlusion,
    rays,
    add
};
inline constexpr std::array<std::string_view, 11> stage_names{
    "prepare", "rows",  "numbers",         "choose", "draw", "bsdf",
    "meet",    "weigh", "light_occlusion", "rays",   "add"};

/// What the stages of a run took, by stopwatch.h.
using StageTicks = std::array<std::uint64_t, stage_names.size()>;

template <class T> struct NamedStage {
    StageKind kind;
    Stage<T> run;
};

/// The stages of one strategy on one material, composed from what the scene calls for: what it does
/// not call for is not in the lists.
template <class T> struct Pipeline {
    PrepareStage<T> prepare = nullptr;  ///< nullptr where no policy looks at the point
    bool draws_every_light = false;
    bool reads_all_lights = false;
    std::size_t table_bytes = 0;             ///< of one point
    std::vector<NamedStage<T>> light, bsdf;  ///< one draw of each half
    /// Where the light half's choice and numbers come from rounds: engine/strata_tile.h; else null.
    const StrataStages<T>* strata = nullptr;
    Stage<T> independent_numbers = nullptr;  ///< of a round's light draws
    SumStages<T> sums;
    bool colour = true;  ///< else the first channel of a sample's value is all three
    int light_draws = 0,
        bsdf_draws = 0;  ///< per sample; for each light, where the policy draws them all
};

/// Composes the pipeline. The strategy is checked (strategy/strategy.h), bsdf a name of the
/// registry; of `numbers`, only their kind matters.
template <class T>
Pipeline<T> compose(const Kernels<T>& kernels, const Strategy& strategy, std::string_view bsdf,
                    const Effects& effects, const NumberSource& numbers = {});

}  // namespace mis
