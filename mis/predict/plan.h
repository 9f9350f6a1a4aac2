#pragma once

#include "mis/predict/choices.h"
#include "mis/predict/heuristics.h"
#include "mis/predict/moments.h"
#include "mis/strategy/strategy.h"

#include <span>
#include <string>
#include <vector>

namespace mis {

/// A strategy at one probe, all names resolved.
struct StrategyPlan {
    int density = -1;  ///< number in Plan::densities; −1 where no light is chosen
    const WeightRule* rule = nullptr;
    DirectionPdf direction = nullptr;  ///< where no light is chosen
    double light_count = 0,
           bsdf_count = 0;  ///< n_i of the multi-sample model, c_i of the one-sample model
    int light_draws = 0, bsdf_draws = 0;  ///< per sample; for each light with `all`
    bool is_one_sample = false;
    bool draws_every_light = false;
};

/// The density of one policy's light draw by one technique.
struct LightDensity {
    std::size_t policy, technique;  ///< numbers in Plan
};

/// Strategies that are integrated at shared nodes: all whose weights are smooth, or those whose
/// weights jump where the ratio of the BSDF's density to one light density takes some values.
struct Group {
    std::vector<std::size_t> strategies;
    std::vector<double> jumps;  ///< of BSDF density over light density, counts left out; ascending
    int density = -1;           ///< which light density; −1: all are smooth
};

/// Some strategies at one probe.
struct Plan {
    std::vector<StrategyPlan> strategies;
    std::vector<PolicyView> policies;
    std::vector<LightTechniqueView> techniques;
    std::vector<LightDensity> densities;
    std::vector<Group> groups;

    Plan(const Scene& scene, const Probe& probe, std::span<const Strategy> asked);

private:
    StrategyPlan planned(const Scene& scene, const Probe& probe, const Strategy& s);
    void add_to_groups(std::size_t strategy);
    std::vector<std::string> policy_names_, technique_names_;
};

/// Empty moments of each strategy. Draws that all count get room for a shift
/// (docs/theory-predict.md, P10).
std::vector<StrategyMoments> empty_moments(const Plan& plan, std::size_t lights);

/// For each light: does every draw towards it meet a light that shines, and count?
std::vector<bool> all_draws_count(const Sky& sky, const LightTechniqueView& technique);

}  // namespace mis
