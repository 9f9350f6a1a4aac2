#include "mis/study/shared_plan.h"

#include "mis/strategy/names.h"

#include <algorithm>

namespace mis {

namespace {

std::size_t place_of(const SharedPlan::Density& d, std::vector<SharedPlan::Density>& densities)
{
    const auto found = std::find_if(densities.begin(), densities.end(), [&](const auto& other) {
        return other.policy == d.policy && other.technique == d.technique;
    });
    const auto place = static_cast<std::size_t>(found - densities.begin());
    if (found == densities.end()) densities.push_back(d);
    return place;
}

}  // namespace

std::size_t place_of(std::string_view name, std::vector<std::string>& names)
{
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
    names.emplace_back(name);
    return names.size() - 1;
}

SharedPlan::SharedPlan(std::span<const Strategy> strategies)
{
    for (const Strategy& s : strategies) {
        Entry entry;
        entry.strategy = s;
        if (!s.chooses_light()) {
            entry.direction = scalar_technique(s.technique);
            entry.bsdf = 1;
            entries.push_back(std::move(entry));
            continue;
        }
        const bool is_every = draws_every_light(s.policy);
        const std::size_t technique = place_of(s.technique, technique_names);
        if (technique == techniques.size()) techniques.push_back(scalar_technique(s.technique));
        entry.density =
            place_of({is_every ? none : place_of(s.policy, policies), technique}, densities);
        if (is_every) entry.every = every_light++;
        entry.heuristic = scalar_heuristic(s.heuristic);
        entry.is_one_sample = s.model == Model::one_sample;
        entry.light = entry.is_one_sample ? 0.5 : s.counts[0];
        entry.bsdf = entry.is_one_sample ? 0.5 : s.counts[1];
        if (entry.is_one_sample) entry.light_share = entry.bsdf_share = 0.5;
        else
            entry.light_draws = std::max(1.0, entry.light),
            entry.bsdf_draws = std::max(1.0, entry.bsdf);
        entry.sums_lights = techniques[technique].sums_lights;
        asks_all_along = asks_all_along || entry.sums_lights;
        entries.push_back(std::move(entry));
    }
}

}  // namespace mis
