#include "mis/predict/evaluate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {

namespace {

constexpr std::size_t padded = Rule::padded;

/// Adds ∫ p y^m, m = 1 … 4, by both rules.
void add_moments(const NodeColumn& p, const NodeColumn& y, const Nodes& nodes, double* kronrod,
                 double* gauss)
{
    constexpr std::size_t lanes = 4;  // sums side by side: a single one could not be vectorised
    std::array<std::array<double, lanes>, 4> k{}, g{};
    for (std::size_t i = 0; i < padded; i += lanes)
        for (std::size_t l = 0; l < lanes; ++l) {
            double term = p[i + l];
            for (std::size_t m = 0; m < 4; ++m) {
                term *= y[i + l];
                k[m][l] += term * nodes.kronrod[i + l];
                g[m][l] += term * nodes.gauss[i + l];
            }
        }
    for (std::size_t m = 0; m < 4; ++m) {
        kronrod[m] += (k[m][0] + k[m][1]) + (k[m][2] + k[m][3]);
        gauss[m] += (g[m][0] + g[m][1]) + (g[m][2] + g[m][3]);
    }
}

/// X = weight · F/density of a draw, less its shift; where nothing is drawn, anything finite.
NodeColumn shifted_value(const NodeColumn& weight, const NodeColumn& value,
                         const NodeColumn& density, double shift)
{
    NodeColumn y;
    for (std::size_t i = 0; i < padded; ++i)
        y[i] = (density[i] > 0 ? weight[i] * value[i] / density[i] : 0) - shift;
    return y;
}

/// A density that rounds to 0 where there is light: the mean is what it is, but no double holds
/// what a draw would be worth, nor its higher moments.
void add_all_but_impossible(const NodeColumn& pdf, const Nodes& nodes, double* kronrod,
                            double* gauss)
{
    for (std::size_t i = 0; i < Rule::nodes; ++i) {
        if (pdf[i] > 0 || !(nodes.value[i] > 0)) continue;
        kronrod[0] += nodes.value[i] * nodes.kronrod[i];
        gauss[0] += nodes.value[i] * nodes.gauss[i];
        for (std::size_t m = 1; m < 4; ++m)
            kronrod[m] = gauss[m] = std::numeric_limits<double>::infinity();
    }
}

NodeColumn scaled(const NodeColumn& column, double factor)
{
    NodeColumn result;
    for (std::size_t i = 0; i < padded; ++i) result[i] = column[i] * factor;
    return result;
}

}  // namespace

void Nodes::place(double begin, double end)
{
    const double middle = (begin + end) / 2, half = (end - begin) / 2;
    for (std::size_t i = 0; i < padded; ++i) {
        theta[i] = middle + half * rule().x[i];
        const double area = half * std::sin(theta[i]);
        kronrod[i] = area * rule().kronrod[i], gauss[i] = area * rule().gauss[i];
    }
}

Tally::Tally(const Plan& plan, const Group& group, const Patch& patch,
             const std::vector<StrategyMoments>& shifts)
{
    for (const std::size_t s : group.strategies) {
        const StrategyMoments& moments = shifts[s];
        first_.push_back(slots_.size());
        if (plan.strategies[s].draws_every_light)
            for (const int light : patch.lights())
                slots_.push_back({s, light, moments.light[static_cast<std::size_t>(light)].shift});
        else if (!moments.light.empty()) slots_.push_back({s, 0, moments.light.front().shift});
        if (!moments.bsdf.empty()) slots_.push_back({s, -1, 0});
    }
}

Evaluator::Evaluator(const Sky& sky, const Response& response, const Plan& plan, const Group& group,
                     const Patch& patch, const Tally& tally)
    : sky_(&sky), response_(&response), plan_(&plan), group_(&group), patch_(&patch),
      tally_(&tally), cap_pdf_(plan.techniques.size() * patch.lights().size()),
      density_(plan.densities.size()), density_used_(plan.densities.size()),
      technique_used_(plan.techniques.size())
{
    for (const std::size_t s : group.strategies) {
        if (plan.strategies[s].density < 0) continue;
        const auto d = static_cast<std::size_t>(plan.strategies[s].density);
        density_used_[d] = true, technique_used_[plan.densities[d].technique] = true;
    }
}

void Evaluator::look(const Vec3<double>& around, int nearest, Nodes& nodes) const
{
    const Vec3<double> radiance = sky_->ball(nearest).radiance;
    const Polar& polar = patch_->polar();
    for (std::size_t i = 0; i < Rule::nodes; ++i) {
        const Vec3<double> wi = polar.pole + polar.offset(around, nodes.theta[i]);
        const ResponseValue r = response_->at(wi);
        nodes.value[i] = luminance(r.f * radiance) * r.cos_theta;
        nodes.bsdf_pdf[i] = response_->draws() ? r.pdf : 0;
        nodes.cos_theta[i] = r.cos_theta;
        nodes.wi_local[i] = response_->to_local(wi);
    }
    constexpr std::size_t middle = Rule::nodes / 2;  // the padding's weight is 0
    for (std::size_t i = Rule::nodes; i < padded; ++i) {
        nodes.value[i] = nodes.value[middle], nodes.bsdf_pdf[i] = nodes.bsdf_pdf[middle];
        nodes.cos_theta[i] = nodes.cos_theta[middle], nodes.wi_local[i] = nodes.wi_local[middle];
    }
}

void Evaluator::price(const Nodes& nodes, const Stretch& stretch, const Meridian& meridian)
{
    const std::size_t lights = patch_->lights().size();
    const std::span along = std::span(meridian.along).subspan(stretch.first_along, stretch.along);
    for (std::size_t t = 0; t < plan_->techniques.size(); ++t) {
        if (!technique_used_[t]) continue;
        for (const int k : along) {
            const Ball& ball = sky_->ball(patch_->lights()[static_cast<std::size_t>(k)]);
            NodeColumn& pdf = cap_pdf_[t * lights + static_cast<std::size_t>(k)];
            for (std::size_t i = 0; i < padded; ++i)
                pdf[i] = plan_->techniques[t].pdf(ball.cap, sky_->n, nodes.cos_theta[i]);
        }
    }
    for (std::size_t d = 0; d < plan_->densities.size(); ++d) {
        if (!density_used_[d]) continue;
        const auto [policy, technique] = plan_->densities[d];
        NodeColumn& sum = density_[d];
        sum.fill(0);
        for (const int k : along) {
            if (!plan_->techniques[technique].sums_lights && k != stretch.nearest_local) continue;
            const auto local = static_cast<std::size_t>(k);
            const double p = plan_->policies[policy]
                                 .probability[static_cast<std::size_t>(patch_->lights()[local])];
            for (std::size_t i = 0; i < padded; ++i)
                sum[i] += p * cap_pdf_[technique * lights + local][i];
        }
    }
}

void Evaluator::add(const Nodes& nodes, const Stretch& stretch, const Meridian& meridian,
                    std::span<double> kronrod, std::span<double> gauss)
{
    price(nodes, stretch, meridian);
    for (std::size_t i = 0; i < group_->strategies.size(); ++i)
        add_strategy(i, nodes, stretch, meridian, kronrod, gauss);
}

void Evaluator::add_strategy(std::size_t i, const Nodes& nodes, const Stretch& stretch,
                             const Meridian& meridian, std::span<double> kronrod,
                             std::span<double> gauss)
{
    const StrategyPlan& s = plan_->strategies[group_->strategies[i]];
    std::size_t slot = tally_->first_slot(i);
    const auto add_to = [&](std::size_t at, const NodeColumn& p, const NodeColumn& y) {
        add_moments(p, y, nodes, &kronrod[4 * at], &gauss[4 * at]);
    };
    if (s.direction != nullptr) {
        NodeColumn pdf, one;
        one.fill(1);
        for (std::size_t k = 0; k < padded; ++k)
            pdf[k] = s.direction(nodes.bsdf_pdf[k], nodes.wi_local[k]);
        add_to(slot, pdf, shifted_value(one, nodes.value, pdf, 0));
        add_all_but_impossible(pdf, nodes, &kronrod[4 * slot], &gauss[4 * slot]);
        return;
    }
    const auto d = static_cast<std::size_t>(s.density);
    const NodeColumn light_density = scaled(density_[d], s.light_count);
    const NodeColumn bsdf_density = scaled(nodes.bsdf_pdf, s.bsdf_count);
    NodeColumn light_weight, bsdf_weight;
    s.rule->weigh(light_density, bsdf_density, light_weight, bsdf_weight);
    if (!s.draws_every_light) {
        add_to(
            slot, density_[d],
            shifted_value(light_weight, nodes.value, light_density, tally_->slots()[slot].shift));
        ++slot;
    } else {
        const std::size_t lights = patch_->lights().size(),
                          technique = plan_->densities[d].technique;
        for (std::size_t a = 0; a < stretch.along; ++a) {
            const auto local = static_cast<std::size_t>(meridian.along[stretch.first_along + a]);
            if (!plan_->techniques[technique].sums_lights &&
                static_cast<int>(local) != stretch.nearest_local)
                continue;
            add_to(slot + local, cap_pdf_[technique * lights + local],
                   shifted_value(light_weight, nodes.value, light_density,
                                 tally_->slots()[slot + local].shift));
        }
        slot += lights;
    }
    if (s.bsdf_draws > 0)
        add_to(slot, nodes.bsdf_pdf, shifted_value(bsdf_weight, nodes.value, bsdf_density, 0));
}

double Evaluator::ratio(const Vec3<double>& around, double theta, const Stretch& stretch,
                        const Meridian& meridian) const
{
    const Polar& polar = patch_->polar();
    const ResponseValue r = response_->at(polar.pole + polar.offset(around, theta));
    const auto [policy, technique] = plan_->densities[static_cast<std::size_t>(group_->density)];
    double light = 0;
    for (std::size_t a = 0; a < stretch.along; ++a) {
        const int k = meridian.along[stretch.first_along + a];
        if (!plan_->techniques[technique].sums_lights && k != stretch.nearest_local) continue;
        const int j = patch_->lights()[static_cast<std::size_t>(k)];
        light += plan_->policies[policy].probability[static_cast<std::size_t>(j)] *
                 plan_->techniques[technique].pdf(sky_->ball(j).cap, sky_->n, r.cos_theta);
    }
    return light > 0 ? r.pdf / light : std::numeric_limits<double>::infinity();
}

}  // namespace mis
