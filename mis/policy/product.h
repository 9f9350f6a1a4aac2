#pragma once

#include "mis/bsdf/any_bsdf.h"
#include "mis/math/frame.h"
#include "mis/policy/irradiance.h"

namespace mis {

/// Draws lights in proportion to what this surface would reflect of them to the viewer if nothing
/// shaded it: the irradiance times the diffuse part of f, and times f's lobe, which a cap wider
/// than the lobe meets in part. The lobe is taken where the cap is nearest to the mirror direction.
/// docs/theory.md, eqs. 62 to 64.
class ProductPolicy {
public:
    static constexpr std::string_view name = "product";
    static constexpr std::string_view summary =
        "in proportion to radiance x what diffuse part and lobe reflect of the cap";
    static constexpr bool draws_every_light = false, looks_at_point = true;
    static constexpr std::size_t table_bytes(std::size_t lights)
    {
        return weight_table_bytes(lights);
    }

    explicit ProductPolicy(const Lights&) {}

    template <class T>
    RunningSum prepare(const ChoicePoint<Scalar<T>>& point, const LightColumns<Scalar<T>>& lights,
                       Scratch& scratch) const
    {
        RunningSum table;
        bool is_glossy = false;
        point.bsdf.visit([&](const auto& bsdf) __attribute__((always_inline)) {
            is_glossy = bsdf.lobe().half_solid_angle > 0;
            if (is_glossy) table = prepare_glossy<T>(bsdf, point, lights, scratch);
        });
        return is_glossy ? table : IrradiancePolicy::prepare_irradiance<T>(point, lights, scratch);
    }

private:
    /// The share of the lobe's albedo that counts as diffuse: where the lobe is taken too low, or
    /// underflows, a light still has a probability.
    static constexpr double defensive = 0.02;

    template <class T, class B>
    MIS_INLINE static RunningSum prepare_glossy(const B& bsdf, const ChoicePoint<Scalar<T>>& point,
                                                const LightColumns<Scalar<T>>& lights,
                                                Scratch& scratch)
    {
        const LobeExtent lobe = bsdf.lobe();
        const double broad = lobe.diffuse + defensive * lobe.specular;
        const T from_origin(length(point.x));
        const Vec3<T> wo{T(point.wo.x), T(point.wo.y), T(point.wo.z)};
        const T extent = number<T>(4 * lobe.half_solid_angle) * wo.z;  // of the lobe, about wi
        const T diffuse = number<T>(lobe.diffuse), flat = number<T>(broad);
        // Inlined by force, as all that kernels call (docs/theory.md, "Instruction sets").
        const auto weight = [&](const SeenLight<T>& light, const Vec3<T>& n)
            __attribute__((always_inline))
        {
            const TiltedCap<T> cap = light.tilted_cap(n);
            const T irradiance = seen_irradiance_over_sin2(light, cap, from_origin);
            const Vec3<T> axis = frame_around(n).to_local(light.to_center /
                                                          max_of(light.distance, number<T>(1e-37)));
            const Vec3<T> wi = nearest_to_mirror(cap, axis, wo);
            const T glossy = max_of(T(luminance(bsdf.evaluate(wo, wi).f) - diffuse), number<T>(0));
            const T cap_over_lobe = cap.sin_max * (cap.sin_max * irradiance) /
                                    max_of(T(extent * wi.z), number<T>(1e-37));
            const T reflected = flat + glossy / max_of(cap_over_lobe, number<T>(1));
            return radiant_irradiance(light, cap, irradiance) * reflected;
        };
        return prepare_by_weight<T>(weight, point, lights, scratch);
    }

    /// The direction of the cap that is nearest to the mirror direction of wo; at the horizon where
    /// it would be below. All in the shading frame.
    template <class T>
    MIS_INLINE static Vec3<T> nearest_to_mirror(const TiltedCap<T>& cap, const Vec3<T>& axis,
                                                const Vec3<T>& wo)
    {
        const Vec3<T> mirror{-wo.x, -wo.y, wo.z};
        const T cos_away = dot(axis, mirror);
        const Vec3<T> across = mirror - axis * cos_away;
        const T sin_away = max_of(length(across), number<T>(1e-30));
        const Vec3<T> rim = axis * cap.cos_max + across * (cap.sin_max / sin_away);
        const auto is_inside = cos_away >= cap.cos_max;
        return {select(is_inside, mirror.x, rim.x), select(is_inside, mirror.y, rim.y),
                max_of(select(is_inside, mirror.z, rim.z), number<T>(1e-4))};
    }
};
static_assert(LightChoice<ProductPolicy, float>);

}  // namespace mis
