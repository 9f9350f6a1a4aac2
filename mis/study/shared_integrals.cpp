#include "mis/study/shared_integrals.h"

namespace mis {

SharedIntegrals::SharedIntegrals(const SharedPlan& plan, std::size_t lights)
    : plan_(&plan), lights_(lights), center_(plan.every_light), seen_mean_(plan.every_light),
      seen_mass_(plan.every_light), pairs_(plan.entries.size()), density_(plan.densities.size()),
      missed_(plan.entries.size()), place_(plan.every_light > 0 ? lights : 0, -1)
{
}

void SharedIntegrals::take(const DirectionSet& set, std::span<SharedSums> sums,
                           std::span<LightSums> lights, bool counts)
{
    light_sums_ = lights;
    begin(set.mixture(), sums);
    for (const SharedDirection& d : set.directions()) {
        if (d.shows_its_light() && d.value > 0) all_.add(d.group, d.value, 1 / d.density);
        over_density_ = 1 / d.density, over_marginal_ = 1 / d.marginal;
        find_densities(set, d);
        for (std::size_t s = 0; s < plan_->entries.size(); ++s) add(s, set, d);
    }
    const double luminance = mean();
    for (std::size_t s = 0; s < plan_->entries.size(); ++s) {
        if (counts) {
            const double variance = variance_of(s);
            sums[s].variance.add(variance);
            sums[s].last += variance;
            sums[s].with_luminance += variance * luminance;
        }
        const std::size_t every = plan_->entries[s].every;
        const bool is_every = every != SharedPlan::none;
        sums[s].rounds += 1;
        sums[s].light_mean += is_every ? seen_mean_[every] : pairs_[s].light.mean();
        sums[s].light_mass += is_every ? seen_mass_[every] : pairs_[s].light.mass();
    }
    if (!lights.empty()) add_rounds_light_sums(lights);
}

void SharedIntegrals::add_rounds_light_sums(std::span<LightSums> lights) const
{
    for (std::size_t m = 0; m < met_.size(); ++m)
        for (std::size_t e = 0; e < plan_->every_light; ++e) {
            LightSums& of = lights[e * lights_ + static_cast<std::size_t>(met_[m])];
            const CentredSums& found = met_sums_[m * plan_->every_light + e];
            of.mean += static_cast<float>(found.mean());
            of.mass += static_cast<float>(found.mass());
        }
}

double SharedIntegrals::mean() const { return all_.mean(); }

void SharedIntegrals::begin(const LightMixture& mixture, std::span<const SharedSums> sums)
{
    for (const LightIndex light : met_) place_[static_cast<std::size_t>(light)] = -1;
    met_.clear(), met_sums_.clear();
    all_ = CentredSums();
    for (std::size_t s = 0; s < plan_->entries.size(); ++s) {
        const SharedPlan::Entry& entry = plan_->entries[s];
        const double center = sums[s].center();
        pairs_[s] = {CentredSums(center), CentredSums()};
        missed_[s] = 0;
        if (entry.every != SharedPlan::none) {
            pairs_[s].light = CentredSums();
            center_[entry.every] = center;
            seen_mean_[entry.every] = seen_mass_[entry.every] = 0;
        }
        if (!entry.is_one_sample) continue;
        // Half of all samples are BSDF draws, most of them worth 0; and where no light can be
        // chosen, so is the other half.
        const bool chooses = mixture.chooses(plan_->densities[entry.density].policy);
        pairs_[s].light.add_known(entry.bsdf + (chooses ? 0 : entry.light));
    }
}

void SharedIntegrals::find_densities(const DirectionSet& set, const SharedDirection& d)
{
    for (std::size_t k = 0; k < plan_->densities.size(); ++k) {
        const SharedPlan::Density& of = plan_->densities[k];
        const auto of_light = [&](std::size_t i) {
            const double pdf = set.pdf(of.technique, d, i);
            return of.policy == SharedPlan::none
                       ? pdf
                       : pdf * set.mixture().probability_by(of.policy, set.light_along(d, i));
        };
        density_[k] = of_light(0);
        if (plan_->techniques[of.technique].sums_lights)
            for (std::size_t i = 1; i < d.along; ++i) density_[k] += of_light(i);
    }
}

void SharedIntegrals::add(std::size_t s, const DirectionSet& set, const SharedDirection& d)
{
    const SharedPlan::Entry& entry = plan_->entries[s];
    const double over_mixture = entry.sums_lights ? over_marginal_ : over_density_;
    const double value = entry.sums_lights || d.shows_its_light() ? d.value : 0;
    Pair& sums = pairs_[s];
    if (entry.density == SharedPlan::none) {
        if (!(value > 0)) return;
        const double pdf = entry.direction.direction_pdf(d.bsdf_pdf, d.local);
        if (pdf > 0) sums.bsdf.add_beyond_0(d.group, value / pdf, pdf * over_mixture);
        else missed_[s] += value * over_mixture;
        return;
    }
    const std::array<double, 2> density{entry.light * density_[entry.density],
                                        entry.bsdf * d.bsdf_pdf};
    if (!(value > 0)) {
        if (density[0] > 0) add_light_draws(s, set, d, 0);
        return;
    }
    if (density[0] > 0)
        add_light_draws(s, set, d,
                        entry.light_draws * entry.heuristic(density, 0) * value / density[0]);
    if (density[1] > 0)
        (entry.is_one_sample ? sums.light : sums.bsdf)
            .add_beyond_0(d.group,
                          entry.bsdf_draws * entry.heuristic(density, 1) * value / density[1],
                          entry.bsdf_share * d.bsdf_pdf * over_mixture);
    if (!(density[0] > 0) && !(density[1] > 0)) missed_[s] += value * over_mixture;
}

void SharedIntegrals::add_light_draws(std::size_t s, const DirectionSet& set,
                                      const SharedDirection& d, double value)
{
    const SharedPlan::Entry& entry = plan_->entries[s];
    const double over_mixture = entry.sums_lights ? over_marginal_ : over_density_;
    if (entry.every == SharedPlan::none) {
        pairs_[s].light.add(d.group, value,
                            entry.light_share * density_[entry.density] * over_mixture);
        return;
    }
    const std::size_t technique = plan_->densities[entry.density].technique;
    for (std::size_t i = 0; i < (entry.sums_lights ? d.along : 1); ++i) {
        const LightIndex light = set.light_along(d, i);
        const double share = set.pdf(technique, d, i) * over_mixture;
        sums_of(set.mixture(), light)[entry.every].add(d.group, value, share);
        seen_mean_[entry.every] += value * share;
        seen_mass_[entry.every] += set.mixture().guess(light) * share;
    }
}

std::span<CentredSums> SharedIntegrals::sums_of(const LightMixture& mixture, LightIndex light)
{
    const auto j = static_cast<std::size_t>(light);
    if (place_[j] < 0) {
        place_[j] = static_cast<std::int32_t>(met_.size());
        met_.push_back(light);
        const double guess = mixture.guess(light);
        for (std::size_t e = 0; e < plan_->every_light; ++e)
            met_sums_.emplace_back(light_sums_.empty()
                                       ? center_[e] * guess
                                       : light_sums_[e * lights_ + j].center(center_[e] * guess));
    }
    return std::span(met_sums_).subspan(static_cast<std::size_t>(place_[j]) * plan_->every_light,
                                        plan_->every_light);
}

double SharedIntegrals::variance_of(std::size_t s) const
{
    const SharedPlan::Entry& entry = plan_->entries[s];
    double variance = pairs_[s].light.variance() / entry.light_draws;
    if (entry.every != SharedPlan::none)
        for (std::size_t m = 0; m < met_.size(); ++m)
            variance +=
                met_sums_[m * plan_->every_light + entry.every].variance() / entry.light_draws;
    return variance + pairs_[s].bsdf.variance() / entry.bsdf_draws;
}

}  // namespace mis
