#pragma once

#include "mis/engine/job.h"
#include "mis/engine/strata_parts.h"
#include "mis/math/moments.h"
#include "mis/scene/material.h"
#include "mis/strategy/strategy.h"

#include <array>
#include <memory>
#include <string_view>
#include <vector>

namespace mis {

/// The stages that a policy brings.
template <class T> struct PolicyStages {
    std::string_view name;
    bool draws_every_light, reads_all_lights;
    std::size_t (*table_bytes)(std::size_t lights);
    PrepareStage<T> prepare;
    Stage<T> choose;       ///< bits → light, probability
    Stage<T> choose_only;  ///< the same where there is one light
    Stage<T> probability;  ///< light → probability
    Stage<T> sum_light_draw,
        sum_bsdf_draw;  ///< of the union: all lights along wi → light_pdf, radiance, distance
};

template <class T> struct LightTechniqueStages {
    std::string_view name;
    bool sums_lights;
    Stage<T> draw;  ///< light, u, v → wi, offset, distance, light_pdf, radiance over pdf
    Stage<T> pdf;   ///< light, wi → light_pdf, radiance
};

template <class T> struct BsdfStages {
    std::string_view name;
    /// wi → contribution (f cos θ), bsdf_pdf: [has a lobe][some wi may be below the horizon]
    std::array<std::array<Stage<T>, 2>, 2> evaluate;
    /// wi, light_pdf → contribution of a light draw beside draws of the lobe, by the balance
    /// heuristic; null where the type has no lobe.
    Stage<T> weigh_parts;
};

/// A draw over the hemisphere by one BSDF under one direction technique.
template <class T> struct DirectionStages {
    std::string_view technique, bsdf;
    Stage<T> draw;  ///< lobe, u, v → wi; a lost draw has wi = 0
    Stage<T> pdf;   ///< wi, bsdf_pdf → bsdf_pdf of the technique
};

template <class T> struct HeuristicStages {
    std::string_view name;
    Stage<T> weigh_light, weigh_bsdf;  ///< contribution: f cos θ → share of the estimate
};

/// What some samples of one point come to.
struct RunSums {
    Moments luminance;      ///< of the observations
    Vec3<double> radiance;  ///< sum over them and those before
};

/// How the samples of a batch add up.
template <class T> struct SumStages {
    Stage<T> add = nullptr;  ///< value += contribution
    /// All values of a batch → luminances.
    void (*find_luminances)(const Batch<T>&, Column<double>&) = nullptr;
    /// Samples [first, end) and what was observed of them → moments of these, and `before` with a
    /// share of all radiances.
    RunSums (*sum_run)(const Batch<T>&, int first, int end, std::span<const double> observed,
                       double share, const Vec3<double>& before) = nullptr;
};

/// What `strata` does over all lights of a point, and with its draws' numbers.
template <class T> struct StrataStages {
    /// [place] of what a point would reflect unshaded; Σ = 1, or all are 0.
    void (*find_shares)(const TileJob<T>&, const ShadingPoint&, std::span<T> shares);
    void (*part_lights)(const StrataKnowledge<T>&, int draws, StrataParts<T>&);
    void (*learn_tile)(const SeenCounts<T>&, std::span<T> means);
    void (*learn_block)(const SeenCounts<T>&, std::span<const T> tile, std::span<T> means);
    void (*numbers)(StrataColumns&, Batch<T>&);  ///< of scrambled sequences
    Stage<T> probability;  ///< light → its expected draws, which ExpectedDraws in the table says
};

/// All stages for one number type and instruction set.
template <class T> struct Kernels {
    std::string_view instruction_set;
    std::size_t lanes;
    Stage<T> light_numbers, bsdf_numbers;              ///< independent
    Stage<T> sobol_light_numbers, sobol_bsdf_numbers;  ///< of scrambled sequences
    Stage<T> screen_meeting;  ///< wi → candidate: which light could wi meet?
    Stage<T>
        screen_hiding;  ///< wi, light, distance → candidate: which other could stand before it?
    Stage<T> weigh_alone;              ///< contribution = f cos θ · L/pdf
    std::array<SumStages<T>, 2> sums;  ///< of grey, where the first channel is all; of colours
    StrataStages<T> strata;
    std::vector<PolicyStages<T>> policies;
    std::vector<LightTechniqueStages<T>> light_techniques;
    std::vector<BsdfStages<T>> bsdfs;
    std::vector<DirectionStages<T>> directions;
    std::vector<HeuristicStages<T>> heuristics;
};

/// The kernels of the best instruction set that this processor has, or of the one that the
/// environment variable MIS_ISA names. Throws std::runtime_error where that is unknown or not to be
/// had here.
template <class T> const Kernels<T>& kernels();

/// The names of the instruction sets that were compiled and that this processor can run, best
/// first.
std::vector<std::string_view> instruction_sets();

/// The kernels of one instruction set. Throws std::runtime_error as kernels() does.
template <class T> const Kernels<T>& kernels_of(std::string_view instruction_set);

}  // namespace mis
