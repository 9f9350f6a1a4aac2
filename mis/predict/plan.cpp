#include "mis/predict/plan.h"

#include <algorithm>

namespace mis {

namespace {

/// The number of `name` in a list; make() fills its entry if it is new.
template <class Entry, class Make>
std::size_t number_of(const std::string& name, std::vector<std::string>& names,
                      std::vector<Entry>& entries, const Make& make)
{
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    entries.push_back(make());
    names.push_back(name);
    return names.size() - 1;
}

}  // namespace

Plan::Plan(const Scene& scene, const Probe& probe, std::span<const Strategy> asked)
{
    for (const Strategy& s : asked) {
        strategies.push_back(planned(scene, probe, s));
        add_to_groups(strategies.size() - 1);
    }
}

StrategyPlan Plan::planned(const Scene& scene, const Probe& probe, const Strategy& s)
{
    if (!s.chooses_light())
        return {.direction = direction_technique(s.technique), .bsdf_count = 1, .bsdf_draws = 1};
    const LightDensity density{number_of(s.policy, policy_names_, policies,
                                         [&] { return policy_at(s.policy, scene, probe); }),
                               number_of(s.technique, technique_names_, techniques,
                                         [&] { return light_technique(s.technique); })};
    const auto same = [&](const LightDensity& d) {
        return d.policy == density.policy && d.technique == density.technique;
    };
    auto found = std::find_if(densities.begin(), densities.end(), same);
    if (found == densities.end()) found = densities.insert(found, density);
    StrategyPlan plan{.density = static_cast<int>(found - densities.begin()),
                      .rule = &weight_rule(s.heuristic)};
    plan.is_one_sample = s.model == Model::one_sample;
    plan.light_draws = s.counts[0], plan.bsdf_draws = s.counts[1];
    plan.light_count = plan.is_one_sample ? 0.5 : plan.light_draws;
    plan.bsdf_count = plan.is_one_sample ? 0.5 : plan.bsdf_draws;
    plan.draws_every_light = policies[density.policy].draws_every_light;
    return plan;
}

void Plan::add_to_groups(std::size_t strategy)
{
    const StrategyPlan& s = strategies[strategy];
    Group group{.strategies = {strategy}};
    if (s.rule != nullptr && s.bsdf_count > 0) {
        for (const double jump : s.rule->jumps)
            group.jumps.push_back(jump * s.light_count / s.bsdf_count);
        if (!group.jumps.empty()) group.density = s.density;
    }
    for (Group& other : groups) {
        if (other.density != group.density) continue;
        other.strategies.push_back(strategy);
        other.jumps.insert(other.jumps.end(), group.jumps.begin(), group.jumps.end());
        std::sort(other.jumps.begin(), other.jumps.end());
        other.jumps.erase(std::unique(other.jumps.begin(), other.jumps.end()), other.jumps.end());
        return;
    }
    groups.push_back(std::move(group));
}

std::vector<StrategyMoments> empty_moments(const Plan& plan, std::size_t lights)
{
    std::vector<StrategyMoments> all;
    for (const StrategyPlan& s : plan.strategies) {
        StrategyMoments moments{.is_one_sample = s.is_one_sample};
        if (s.light_draws > 0)
            moments.light.assign(s.draws_every_light ? lights : 1,
                                 {.draws = static_cast<double>(s.light_draws)});
        if (s.bsdf_draws > 0) moments.bsdf.assign(1, {.draws = static_cast<double>(s.bsdf_draws)});
        all.push_back(std::move(moments));
    }
    return all;
}

std::vector<bool> all_draws_count(const Sky& sky, const LightTechniqueView& technique)
{
    std::vector<bool> counts(sky.lights);
    for (std::size_t j = 0; j < sky.lights; ++j) {
        const Ball& ball = sky.balls[j];
        bool all = ball.shines() && technique.keeps_above(ball, sky.n);
        for (const int k : sky.neighbours[j]) {
            const bool is_harmless = technique.sums_lights && sky.ball(k).shines();
            all = all && (is_harmless || !could_hide(sky.ball(k), ball));
        }
        counts[j] = all;
    }
    return counts;
}

}  // namespace mis
