#pragma once

#include "mis/technique/technique.h"

namespace mis {

/// Uniform over the cap of the chosen light; a sample counts only if that light is the nearest
/// thing hit.
struct ConeTechnique {
    static constexpr std::string_view name = "cone";
    static constexpr std::string_view summary = "uniform over the cap of the chosen light";
    static constexpr bool chooses_light = true, sums_lights = false;
    template <class T>
    MIS_INLINE static CapDraw<T> draw(const Cap<T>& cap, const Vec3<T>& n, const Vec2<T>& u)
    {
        return sample_cone_over(cap, n, u);
    }
    template <class T> MIS_INLINE static T pdf(const Cap<T>& cap, const Vec3<T>&, const T&)
    {
        return cone_pdf(cap);
    }
};
static_assert(LightTechnique<ConeTechnique, float>);

}  // namespace mis
