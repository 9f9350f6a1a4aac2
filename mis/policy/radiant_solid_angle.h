#pragma once

#include "mis/policy/weight_table.h"

namespace mis {

/// Draws lights in proportion to radiance × solid angle of their cap.
class RadiantSolidAnglePolicy {
public:
    static constexpr std::string_view name = "radiant-solid-angle";
    static constexpr std::string_view summary = "in proportion to radiance x solid angle";
    static constexpr bool ranked_by_default(std::size_t, bool) { return true; }
    static constexpr bool draws_every_light = false, reads_all_lights = true;
    static constexpr std::size_t table_bytes(std::size_t lights)
    {
        return weight_table_bytes<RadiantSolidAnglePolicy>(lights);
    }

    explicit RadiantSolidAnglePolicy(const Lights&) {}

    template <class T>
    WeightTable<T, RadiantSolidAnglePolicy> prepare(const ChoicePoint<Scalar<T>>& point,
                                                    const LightColumns<Scalar<T>>& lights,
                                                    Scratch& scratch) const
    {
        return WeightTable<T, RadiantSolidAnglePolicy>::over(point, lights, scratch);
    }
    template <class T, class Use>
    MIS_INLINE static void visit_weight(const ChoicePoint<Scalar<T>>&, const Use& use)
    {
        use([](const SeenLight<T>& light, const Vec3<T>&) __attribute__((always_inline)) {
            // Y(L)·Ω ∝ (Y(L)·r) · Ω/r.
            return light.luminance_radius * light.solid_angle_over_radius();
        });
    }
};
static_assert(LightChoice<RadiantSolidAnglePolicy, float>);

}  // namespace mis
