#pragma once

#include "mis/policy/light_choice.h"

namespace mis {

/// Draws lights in proportion to what they would give a white surface that nothing shades: radiance
/// × irradiance of the cap, clipped at the horizon. Lights below the horizon are never drawn.
class IrradiancePolicy {
public:
    static constexpr std::string_view name = "irradiance";
    static constexpr std::string_view summary =
        "in proportion to radiance x irradiance of the cap above the horizon";
    static constexpr bool draws_every_light = false, looks_at_point = true;
    static constexpr std::size_t table_bytes(std::size_t lights)
    {
        return weight_table_bytes(lights);
    }

    explicit IrradiancePolicy(const Lights&) {}

    template <class T>
    RunningSum prepare(const ChoicePoint<Scalar<T>>& point, const LightColumns<Scalar<T>>& lights,
                       Scratch& scratch) const
    {
        const T from_origin(length(point.x));
        // Y(L)·E ∝ (Y(L)·r/d) · sin θ_max · E/sin²θ_max.
        const auto weight = [&](const SeenLight<T>& light, const Vec3<T>& n) {
            const TiltedCap<T> cap = light.tilted_cap(n);
            const T d = max_of(light.distance, light.radius);
            const T irradiance = max_of(irradiance_over_sin2(cap),
                                        least_over_sin2<T>(cap, number<T>(1) + from_origin / d));
            return light.luminance_radius / d * (cap.sin_max * irradiance);
        };
        return prepare_by_weight<T>(weight, point, lights, scratch);
    }

private:
    /// Of a light that rounding may have put below the horizon: E/sin²θ_max of one that is as far
    /// above tangency as angles are uncertain, for it may be visible. coordinates: the largest over
    /// the distance. docs/theory.md, eq. 52.
    template <class T> MIS_INLINE static T least_over_sin2(const TiltedCap<T>& cap, T coordinates)
    {
        using std::sqrt;
        const T blur = number<T>(8) * T(std::numeric_limits<Scalar<T>>::epsilon()) * coordinates;
        const T share = blur / max_of(cap.sin_max, blur);
        const T least = blur * share * sqrt(share);
        return select(cap.sin_max + cap.cos_beta > -blur, least, number<T>(0));
    }
};
static_assert(LightChoice<IrradiancePolicy, float>);

}  // namespace mis
