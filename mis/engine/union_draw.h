#pragma once

#include "mis/math/cap.h"
#include "mis/trace/lights.h"

namespace mis {

// The density of the union of the lights' caps: Σ P_k/Ω_k over all lights along a direction. In
// double, and always as a ratio to the density of one light, which is exactly 1 where its cap is
// the only one. probability_of(j): P_j. solid_angle_of(j): Ω_j, steradians.

/// Of a light from x, steradians.
MIS_INLINE double solid_angle_from(const Vec3<double>& x, const Light& light)
{
    return cap_of_sphere(light.center, light.radius, x).solid_angle();
}

/// A light draw as a draw in the union.
struct UnionDraw {
    LightHit nearest;  ///< the light that is seen
    double ratio = 1;  ///< the drawn light's own density over the union's
};

/// own: the light drawn, which the direction meets by construction; own_density: its P/Ω.
template <class ProbabilityOf, class SolidAngleOf>
MIS_INLINE UnionDraw draw_in_union(const LightHierarchy& lights, const Vec3<double>& x,
                                   const Vec3<double>& wi, const LightHit& own, double own_density,
                                   const ProbabilityOf& probability_of,
                                   const SolidAngleOf& solid_angle_of)
{
    LightHit nearest = own;
    double others = 0;
    lights.for_each_along(x, wi, [&](const LightHit& hit) {
        if (hit.light == own.light) return;
        others += probability_of(hit.light) / (solid_angle_of(hit.light) * own_density);
        if (stands_before(hit, nearest)) nearest = hit;
    });
    return {nearest, 1 / (1 + others)};
}

/// The union's density of a direction that another technique drew and that meets light `met`, whose
/// own density is met_pdf.
template <class T, class ProbabilityOf, class SolidAngleOf>
MIS_INLINE T union_density(const LightHierarchy& lights, const Vec3<double>& x,
                           const Vec3<double>& wi, LightIndex met, const T& met_pdf,
                           const ProbabilityOf& probability_of, const SolidAngleOf& solid_angle_of)
{
    double own = 0, others = 0;
    lights.for_each_along(x, wi, [&](const LightHit& hit) {
        (hit.light == met ? own : others) += probability_of(hit.light) / solid_angle_of(hit.light);
    });
    return own > 0 ? met_pdf * static_cast<T>((own + others) / own) : static_cast<T>(others);
}

}  // namespace mis
