#pragma once

#include "mis/sampling/projected.h"
#include "mis/technique/technique.h"

namespace mis {

/// In proportion to the cosine, over what of the chosen light's cap is above the horizon; a sample
/// counts only if that light is the nearest thing hit.
struct ProjectedTechnique {
    static constexpr std::string_view name = "projected";
    static constexpr std::string_view summary =
        "in proportion to the cosine over the chosen light's cap, above the horizon";
    static constexpr std::string_view ranked_by_default_with = "product/light";
    static constexpr bool chooses_light = true, sums_lights = false;
    static constexpr bool draws_by_irradiance = true;  ///< the density is cos θ/E
    template <class T>
    MIS_INLINE static CapDraw<T> draw(const Cap<T>& cap, const Vec3<T>& n, const Vec2<T>& u)
    {
        return sample_projected(cap, n, u);
    }
    template <class T>
    MIS_INLINE static T pdf(const Cap<T>& cap, const Vec3<T>& n, const T& cos_theta)
    {
        return projected_pdf(cap, n, cos_theta);
    }
};
static_assert(LightTechnique<ProjectedTechnique, float>);

}  // namespace mis
