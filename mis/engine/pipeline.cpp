#include "mis/engine/pipeline.h"

#include "mis/engine/stages_trace.h"
#include "mis/math/raise.h"
#include "mis/scene/named.h"

#include <stdexcept>
#include <string>

namespace mis {

namespace {

template <class T>
const DirectionStages<T>& direction(const Kernels<T>& kernels, std::string_view technique,
                                    std::string_view bsdf)
{
    for (const DirectionStages<T>& entry : kernels.directions)
        if (entry.technique == technique && entry.bsdf == bsdf) return entry;
    raise<std::out_of_range>("no draw is made for " + std::string(technique) + " on " +
                             std::string(bsdf));
}

template <class T>
Stage<T> evaluation(const Kernels<T>& kernels, std::string_view bsdf, const Effects& effects)
{
    return require_named(kernels.bsdfs, "BSDF", bsdf)
        .evaluate[effects.on.has(Effect::specular)][effects.on.has(Effect::horizon)];
}

template <class T> void add_surfaces(std::vector<NamedStage<T>>& stages, const Effects& effects)
{
    if (effects.on.has(Effect::shadows)) stages.push_back({StageKind::rays, hide_by_surfaces<T>});
}

template <class T>
std::vector<NamedStage<T>> light_half(const Kernels<T>& kernels, const Strategy& s,
                                      std::string_view bsdf, const Effects& effects,
                                      Stage<T> numbers)
{
    const PolicyStages<T>& policy = require_named(kernels.policies, "policy", s.policy);
    const LightTechniqueStages<T>& technique =
        require_named(kernels.light_techniques, "technique", s.technique);
    std::vector<NamedStage<T>> stages;
    if (s.model != Model::strata) {  // whose rows, numbers and choices are its rounds'
        stages.push_back({StageKind::rows, start_rows<T>});
        if (s.model == Model::one_sample) stages.push_back({StageKind::rows, keep_light_rows<T>});
        stages.push_back({StageKind::numbers, numbers});
        stages.push_back({StageKind::choose,
                          effects.on.has(Effect::choice) ? policy.choose : policy.choose_only});
    }
    stages.push_back({StageKind::draw, technique.draw});
    if (technique.sums_lights && effects.on.has(Effect::light_occlusion))
        stages.push_back({StageKind::meet, policy.sum_light_draw});
    if (s.model == Model::strata && s.counts[1] > 0) {
        stages.push_back({StageKind::bsdf, require_named(kernels.bsdfs, "BSDF", bsdf).weigh_parts});
    } else {
        stages.push_back({StageKind::bsdf, evaluation(kernels, bsdf, effects)});
        stages.push_back({StageKind::weigh,
                          require_named(kernels.heuristics, "heuristic", s.heuristic).weigh_light});
    }
    // The cheaper question first: what one answer hides, the other is not asked about.
    const bool is_screened = effects.lights <= most_screened_lights;
    if (!is_screened) add_surfaces(stages, effects);
    if (!technique.sums_lights && effects.on.has(Effect::light_occlusion)) {
        if (is_screened) stages.push_back({StageKind::light_occlusion, kernels.screen_hiding});
        stages.push_back({StageKind::light_occlusion, hide_by_lights<T>});
    }
    if (is_screened) add_surfaces(stages, effects);
    stages.push_back({StageKind::add, kernels.sums[effects.on.has(Effect::colour)].add});
    return stages;
}

/// A BSDF draw beside light draws.
template <class T>
std::vector<NamedStage<T>> bsdf_half(const Kernels<T>& kernels, const Strategy& s,
                                     std::string_view bsdf, const Effects& effects,
                                     Stage<T> numbers)
{
    const PolicyStages<T>& policy = require_named(kernels.policies, "policy", s.policy);
    const LightTechniqueStages<T>& technique =
        require_named(kernels.light_techniques, "technique", s.technique);
    std::vector<NamedStage<T>> stages{{StageKind::rows, start_rows<T>}};
    if (s.model == Model::one_sample) stages.push_back({StageKind::rows, keep_bsdf_rows<T>});
    stages.push_back({StageKind::numbers, numbers});
    stages.push_back({StageKind::draw, direction(kernels, "brdf", bsdf).draw});
    if (effects.lights <= most_screened_lights)
        stages.push_back({StageKind::meet, kernels.screen_meeting});
    stages.push_back({StageKind::meet, meet_lights<T>});
    stages.push_back({StageKind::choose,
                      s.model == Model::strata ? kernels.strata.probability : policy.probability});
    stages.push_back({StageKind::draw, technique.pdf});
    if (technique.sums_lights && effects.on.has(Effect::light_occlusion))
        stages.push_back({StageKind::meet, policy.sum_bsdf_draw});
    stages.push_back({StageKind::bsdf, evaluation(kernels, bsdf, effects)});
    stages.push_back(
        {StageKind::weigh, require_named(kernels.heuristics, "heuristic", s.heuristic).weigh_bsdf});
    add_surfaces(stages, effects);
    stages.push_back({StageKind::add, kernels.sums[effects.on.has(Effect::colour)].add});
    return stages;
}

/// A direction technique by itself.
template <class T>
std::vector<NamedStage<T>> direction_alone(const Kernels<T>& kernels, const Strategy& s,
                                           std::string_view bsdf, const Effects& effects,
                                           Stage<T> numbers)
{
    const DirectionStages<T>& draw = direction(kernels, s.technique, bsdf);
    std::vector<NamedStage<T>> stages{{StageKind::rows, start_rows<T>},
                                      {StageKind::numbers, numbers},
                                      {StageKind::draw, draw.draw}};
    if (effects.lights <= most_screened_lights)
        stages.push_back({StageKind::meet, kernels.screen_meeting});
    stages.push_back({StageKind::meet, meet_lights<T>});
    stages.push_back({StageKind::draw, fetch_radiance<T>});
    stages.push_back({StageKind::bsdf, evaluation(kernels, bsdf, effects)});
    stages.push_back({StageKind::bsdf, draw.pdf});
    stages.push_back({StageKind::weigh, kernels.weigh_alone});
    add_surfaces(stages, effects);
    stages.push_back({StageKind::add, kernels.sums[effects.on.has(Effect::colour)].add});
    return stages;
}

}  // namespace

template <class T>
Pipeline<T> compose(const Kernels<T>& kernels, const Strategy& s, std::string_view bsdf,
                    const Effects& effects, const NumberSource& numbers)
{
    const Stage<T> light_numbers =
        numbers.is_sobol() ? kernels.sobol_light_numbers : kernels.light_numbers;
    const Stage<T> bsdf_numbers =
        numbers.is_sobol() ? kernels.sobol_bsdf_numbers : kernels.bsdf_numbers;
    Pipeline<T> pipeline;
    pipeline.colour = effects.on.has(Effect::colour);
    pipeline.sums = kernels.sums[effects.on.has(Effect::colour)];
    if (!s.chooses_light()) {
        pipeline.bsdf = direction_alone(kernels, s, bsdf, effects, bsdf_numbers);
        pipeline.bsdf_draws = 1;
        return pipeline;
    }
    const PolicyStages<T>& policy = require_named(kernels.policies, "policy", s.policy);
    pipeline.reads_all_lights = policy.reads_all_lights;
    if (s.model == Model::strata) {
        pipeline.strata = &kernels.strata;
        pipeline.independent_numbers = kernels.light_numbers;
    } else {
        pipeline.prepare = policy.prepare;
        pipeline.draws_every_light = policy.draws_every_light;
        pipeline.table_bytes = policy.table_bytes(effects.lights);
    }
    pipeline.light = light_half(kernels, s, bsdf, effects, light_numbers);
    pipeline.light_draws = s.counts[0];
    pipeline.bsdf_draws = s.counts[1];
    if (pipeline.bsdf_draws > 0) pipeline.bsdf = bsdf_half(kernels, s, bsdf, effects, bsdf_numbers);
    return pipeline;
}

template Pipeline<float> compose(const Kernels<float>&, const Strategy&, std::string_view,
                                 const Effects&, const NumberSource&);
template Pipeline<double> compose(const Kernels<double>&, const Strategy&, std::string_view,
                                  const Effects&, const NumberSource&);

}  // namespace mis
