#pragma once

#include "mis/bsdf/bsdf.h"
#include "mis/scene/scene.h"
#include "mis/scene/shading_point.h"

#include <string_view>

namespace mis {

// Scenes in code. The shading point is the origin, its normal +y, unless said otherwise.

/// Thirty lights of all sizes and powers, above and below the horizon, the seventh of them black.
Lights thirty_lights_one_dark();

/// At the origin, normal +y, seen from above at an angle.
ShadingPoint point_facing_up();

/// Materials of a type that tests of every BSDF go through: ordinary ones, coloured ones, and the
/// ends of each range.
std::vector<Material> materials_of(std::string_view type);

/// Three lights above the horizon, none before another; one is coloured.
Lights three_lights_apart();

/// A lamp before the middle of a larger and dimmer one, and a third apart.
Lights eclipse();

/// A probe at point_facing_up() of a material, under lights; no surface.
Scene probe_under(const Lights& lights, const Material& material);

/// White, of albedo ½.
Material grey_floor();

/// Irradiance from a whole unoccluded sphere above the horizon: π sin²θ_max cos β · L = π r² L cos
/// β/d².
Vec3<double> irradiance(const Light& light, const Vec3<double>& x, const Vec3<double>& n);

/// ∫ f cos θ L over the lights' caps by quadrature, where no cap overlaps another and all are above
/// the horizon.
template <class B>
Vec3<double> direct_radiance(const B& bsdf, const Lights& lights, const ShadingPoint& point);

}  // namespace mis

#include "tests/support/quadrature.h"

#include "mis/math/cap.h"

namespace mis {

template <class B>
Vec3<double> direct_radiance(const B& bsdf, const Lights& lights, const ShadingPoint& point)
{
    const Frame<double> frame = frame_around(vec_cast<double>(point.n));
    const Vec3<double> wo = frame.to_local(vec_cast<double>(point.wo));
    Vec3<double> sum(0);
    for (const Light& light : lights) {
        const Cap<double> cap = cap_of_sphere(light.center, light.radius, point.x);
        const auto reflected = [&](const Vec3<double>& wi) {
            const Vec3<double> local = frame.to_local(wi);
            return Vec3<double>(bsdf.evaluate(wo, local).f * local.z);
        };
        sum += radiance(light) * integral_over_cap(cap.axis, cap.one_minus_cos(), reflected);
    }
    return sum;
}

}  // namespace mis
