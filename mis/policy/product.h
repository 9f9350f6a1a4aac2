#pragma once

#include "mis/policy/seen_product.h"
#include "mis/policy/weight_table.h"

namespace mis {

/// Draws lights in proportion to what this surface would reflect of them to the viewer if nothing
/// shaded it: the irradiance times the diffuse part of f, and times f's lobe, which a cap wider
/// than the lobe meets in part. docs/theory.md, eqs. 62 to 64.
class ProductPolicy {
public:
    static constexpr std::string_view name = "product";
    static constexpr std::string_view summary =
        "in proportion to radiance x what diffuse part and lobe reflect of the cap";
    static constexpr bool ranked_by_default(std::size_t, bool) { return true; }
    static constexpr bool draws_every_light = false, reads_all_lights = true;
    static constexpr bool weighs_by_irradiance = true;  ///< where there is no lobe
    static constexpr std::size_t table_bytes(std::size_t lights)
    {
        return weight_table_bytes<ProductPolicy>(lights);
    }

    explicit ProductPolicy(const Lights&) {}

    template <class T>
    WeightTable<T, ProductPolicy> prepare(const ChoicePoint<Scalar<T>>& point,
                                          const LightColumns<Scalar<T>>& lights,
                                          Scratch& scratch) const
    {
        return WeightTable<T, ProductPolicy>::over(point, lights, scratch);
    }
    template <class T, class Use>
    MIS_INLINE static void visit_weight(const ChoicePoint<Scalar<T>>& point, const Use& use)
    {
        const T from_origin(length(point.x));
        visit_reflection<T>(
            point, [&](const auto& reflection) __attribute__((always_inline)) {
                use([&](const SeenLight<T>& light, const Vec3<T>& n)
                        __attribute__((always_inline)) {
                            return reflected_weight(reflection, light, n, from_origin);
                        });
            });
    }
};
static_assert(LightChoice<ProductPolicy, float>);

}  // namespace mis
