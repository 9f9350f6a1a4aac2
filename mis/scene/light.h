#pragma once

#include "mis/math/large_vector.h"
#include "mis/math/vec.h"

#include <cstdint>
#include <numbers>

namespace mis {

/// Number of a light in its scene; no_light where there is none.
using LightIndex = std::int32_t;
/// No light's number.
inline constexpr LightIndex no_light = -1;

/// A spherical light: constant radiance, outwards only. One packed record, since a draw needs all
/// of it at once. The colour is kept as radiance × radius: it stays a normal float for radii from
/// 1e-30 to 1e12, where radiance (of a light of given power) or its product with r² would leave the
/// range.
struct Light {
    Vec3<double> center;          ///< scene units
    double radius;                ///< scene units, > 0
    Vec3<float> radiance_radius;  ///< radiance · radius, RGB, W·sr⁻¹·m⁻² × scene units
};

/// All lights of a scene, in the order of the file.
using Lights = LargeVector<Light>;

/// Emitted radiance, W·sr⁻¹·m⁻².
inline Vec3<double> radiance(const Light& light)
{
    return vec_cast<double>(light.radiance_radius) / light.radius;
}

/// A light of given radiance.
inline Light make_light(const Vec3<double>& center, double radius, const Vec3<double>& radiance)
{
    return {center, radius, vec_cast<float>(radiance * radius)};
}

/// A light that emits `power` watts per channel: radiance = power/(4π²r²). radiance · radius is
/// formed directly, so that neither r² nor the radiance has to be a number that a float can hold.
inline Light make_light_of_power(const Vec3<double>& center, double radius,
                                 const Vec3<double>& power)
{
    constexpr double four_pi2 = 4 * std::numbers::pi * std::numbers::pi;
    return {center, radius, vec_cast<float>(power / (four_pi2 * radius))};
}

/// Luminance of the radiance, times radius: what the policies weigh by.
inline double luminance_radius(const Light& light)
{
    return luminance(vec_cast<double>(light.radiance_radius));
}

}  // namespace mis
