#pragma once

#include "mis/predict/rule.h"
#include "mis/predict/sky.h"

#include <string_view>
#include <vector>

namespace mis {

/// What a policy says of each light at a probe.
struct PolicyView {
    std::vector<double> probability;  ///< of each light; all 0 where no light is drawn
    bool draws_every_light = false;   ///< one draw for every light: each probability is 1
};

/// Throws std::out_of_range for a name that is not registered, as the functions below do.
PolicyView policy_at(std::string_view policy, const Scene& scene, const Probe& probe);

/// A technique that draws in a light's cap, by name.
struct LightTechniqueView {
    bool sums_lights = false;
    /// Density of a draw in the cap at a direction in it, per steradian.
    double (*pdf)(const Cap<double>& cap, const Vec3<double>& n, double cos_theta) = nullptr;
    /// Does a draw never go below the horizon?
    bool keeps_above(const Ball& ball, const Vec3<double>& n) const;
};
LightTechniqueView light_technique(std::string_view technique);

/// A technique that draws over the hemisphere: its density from the BSDF's and the direction in the
/// shading frame.
using DirectionPdf = double (*)(double bsdf_pdf, const Vec3<double>& wi_local);
DirectionPdf direction_technique(std::string_view technique);

}  // namespace mis
