#pragma once

#include "mis/policy/seen_irradiance.h"
#include "mis/policy/weight_table.h"

namespace mis {

/// Draws lights in proportion to what they would give a white surface that nothing shades: radiance
/// × irradiance of the cap, clipped at the horizon. Lights below the horizon are never drawn.
class IrradiancePolicy {
public:
    static constexpr std::string_view name = "irradiance";
    static constexpr std::string_view summary =
        "in proportion to radiance x irradiance of the cap above the horizon";
    /// Without a lobe it is `product`.
    static constexpr bool ranked_by_default(std::size_t, bool has_lobes) { return has_lobes; }
    static constexpr bool draws_every_light = false, reads_all_lights = true;
    static constexpr bool weighs_by_irradiance = true;
    static constexpr std::size_t table_bytes(std::size_t lights)
    {
        return weight_table_bytes<IrradiancePolicy>(lights);
    }

    explicit IrradiancePolicy(const Lights&) {}

    template <class T>
    WeightTable<T, IrradiancePolicy> prepare(const ChoicePoint<Scalar<T>>& point,
                                             const LightColumns<Scalar<T>>& lights,
                                             Scratch& scratch) const
    {
        return WeightTable<T, IrradiancePolicy>::over(point, lights, scratch);
    }
    template <class T, class Use>
    MIS_INLINE static void visit_weight(const ChoicePoint<Scalar<T>>& point, const Use& use)
    {
        const T from_origin(length(point.x));
        use([&](const SeenLight<T>& light, const Vec3<T>& n) __attribute__((always_inline)) {
            const TiltedCap<T> cap = light.tilted_cap(n);
            return radiant_irradiance(light, cap,
                                      seen_irradiance_over_sin2(light, cap, from_origin));
        });
    }
};
static_assert(LightChoice<IrradiancePolicy, float>);

}  // namespace mis
