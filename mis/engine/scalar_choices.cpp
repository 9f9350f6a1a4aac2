#include "mis/engine/scalar_choices.h"

#include "mis/bsdf/registry.h"
#include "mis/engine/light_columns.h"
#include "mis/heuristic/registry.h"
#include "mis/policy/registry.h"
#include "mis/scene/named.h"
#include "mis/technique/registry.h"

#include <memory>

namespace mis {

ScalarBsdf scalar_bsdf(const Material& material)
{
    return require_named(Bsdfs{}, "BSDF", material.type, [&]<class B>() {
        ScalarBsdf made;
        const B bsdf(material);
        made.evaluate = [bsdf](const Vec3<double>& wo, const Vec3<double>& wi) {
            return bsdf.evaluate(wo, wi);
        };
        made.sample = [bsdf](const Vec3<double>& wo, double lobe, const Vec2<double>& u) {
            return bsdf.sample(wo, lobe, u);
        };
        made.draws = bsdf.draws();
        if constexpr (B::has_lobe) made.lobe_share = bsdf.lobe_share();
        return made;
    });
}

ScalarHeuristic scalar_heuristic(std::string_view name)
{
    return require_named(Heuristics{}, "heuristic", name, []<class H>() -> ScalarHeuristic {
        return [](const std::array<double, 2>& density, std::size_t i) {
            return H::weight(density, i);
        };
    });
}

ScalarTechnique scalar_technique(std::string_view name)
{
    return require_named(Techniques{}, "technique", name, []<class K>() {
        ScalarTechnique made;
        if constexpr (K::chooses_light) {
            made.sums_lights = K::sums_lights;
            made.light_pdf = [](const Cap<double>& cap, const Vec3<double>& n, double cos_theta) {
                return K::pdf(cap, n, cos_theta);
            };
        } else {
            made.direction_pdf = [](double bsdf_pdf, const Vec3<double>& wi) {
                return K::pdf(bsdf_pdf, wi);
            };
        }
        return made;
    });
}

ScalarPolicy::ScalarPolicy(std::string_view name, const Lights& lights,
                           const std::shared_ptr<const void>& made)
    : lights_(&lights), scratch_(64 + require_named(Policies{}, "policy", name, [&]<class P>() {
                                     return P::table_bytes(lights.size());
                                 }))
{
    visit_named(Policies{}, name, [&]<class P>() {
        const auto policy =
            made ? std::static_pointer_cast<const P>(made) : std::make_shared<const P>(lights);
        draws_every_light_ = P::draws_every_light;
        reads_all_lights_ = P::reads_all_lights;
        has_tables_ = P::table_bytes(lights.size()) > 0;
        prepare_ = [policy](const ChoicePoint<double>& point, const LightColumns<double>& columns,
                            Scratch& scratch) {
            const auto table = policy->template prepare<double>(point, columns, scratch);
            return Table{[table, policy](std::uint64_t bits) { return table.choose(bits); },
                         [table, policy](LightIndex j) { return table.probability(j); }};
        };
    });
}

const ScalarPolicy::Table& ScalarPolicy::at(const Vec3<double>& x, const Vec3<double>& n,
                                            const Vec3<double>& wo, const AnyBsdf& bsdf)
{
    const LightColumns<double> columns =
        reads_all_lights_ ? fill_light_columns(*lights_, x, columns_) : LightColumns<double>{};
    return at({Vec3<double>(0), n, wo, bsdf, x}, columns);
}

const ScalarPolicy::Table& ScalarPolicy::at(const ChoicePoint<double>& point,
                                            const LightColumns<double>& columns)
{
    scratch_.clear();
    table_ = prepare_(point, columns, scratch_);
    return table_;
}

}  // namespace mis
