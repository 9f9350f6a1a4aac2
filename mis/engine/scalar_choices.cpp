#include "mis/engine/scalar_choices.h"

#include "mis/bsdf/registry.h"
#include "mis/engine/light_columns.h"
#include "mis/heuristic/registry.h"
#include "mis/policy/registry.h"
#include "mis/scene/raise.h"
#include "mis/technique/registry.h"

#include <memory>
#include <stdexcept>
#include <string>

namespace mis {

ScalarBsdf scalar_bsdf(const Material& material)
{
    ScalarBsdf made;
    for_each_type(Bsdfs{}, [&]<class B>() {
        if (B::name != material.type) return;
        const B bsdf(material);
        made.evaluate = [bsdf](const Vec3<double>& wo, const Vec3<double>& wi) {
            return bsdf.evaluate(wo, wi);
        };
        made.sample = [bsdf](const Vec3<double>& wo, double lobe, const Vec2<double>& u) {
            return bsdf.sample(wo, lobe, u);
        };
        made.draws = bsdf.draws();
        if constexpr (B::has_lobe) made.lobe_share = bsdf.lobe_share();
    });
    if (!made.evaluate) raise<std::out_of_range>("no BSDF is called " + material.type);
    return made;
}

ScalarHeuristic scalar_heuristic(std::string_view name)
{
    ScalarHeuristic made;
    for_each_type(Heuristics{}, [&]<class H>() {
        if (H::name == name)
            made = [](const std::array<double, 2>& density, std::size_t i) {
                return H::weight(density, i);
            };
    });
    if (!made) raise<std::out_of_range>("no heuristic is called " + std::string(name));
    return made;
}

ScalarTechnique scalar_technique(std::string_view name)
{
    ScalarTechnique made;
    for_each_type(Techniques{}, [&]<class K>() {
        if (K::name != name) return;
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
    });
    if (!made.light_pdf && !made.direction_pdf)
        raise<std::out_of_range>("no technique is called " + std::string(name));
    return made;
}

namespace {

std::size_t table_bytes_of(std::string_view name, std::size_t lights)
{
    std::size_t bytes = 0;
    for_each_type(Policies{}, [&]<class P>() {
        if (P::name == name) bytes = P::table_bytes(lights);
    });
    return bytes;
}

}  // namespace

ScalarPolicy::ScalarPolicy(std::string_view name, const Lights& lights)
    : lights_(&lights), scratch_(table_bytes_of(name, lights.size()) + 64)
{
    for_each_type(Policies{}, [&]<class P>() {
        if (P::name != name) return;
        const auto policy = std::make_shared<const P>(lights);
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
    if (!prepare_) raise<std::out_of_range>("no policy is called " + std::string(name));
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
