#pragma once

#include "mis/bsdf/bsdf.h"

#include "tests/support/polar_grid.h"
#include "tests/support/scenes.h"

namespace mis {

/// Directions to the viewer: straight above, at 45 degrees, and near the horizon.
inline std::vector<Vec3<double>> viewers()
{
    return {{0, 0, 1},
            normalized(Vec3<double>{0.6, -0.8, 1}),
            normalized(Vec3<double>{0.9, 0.4, 0.05})};
}

/// Angle over which the specular lobe falls off, radians.
inline double lobe_width(const Material& material)
{
    return std::min(1.0,
                    material.type == "ggx" ? material.alpha : 1 / std::sqrt(material.exponent + 1));
}

/// Cells around the mirror direction, fine enough for the material's lobe, which is long and thin
/// near the horizon.
inline PolarGrid grid_of(const Material& material, const Vec3<double>& wo)
{
    return PolarGrid({-wo.x, -wo.y, wo.z}, 0.1 * lobe_width(material), 20, wo.z < 0.1 ? 48 : 16);
}

inline std::string description(const Material& m, const Vec3<double>& wo)
{
    return m.type + ", diffuse " + std::to_string(m.diffuse.x) + ", specular " +
           std::to_string(m.specular.x) + ", exponent " + std::to_string(m.exponent) + ", alpha " +
           std::to_string(m.alpha) + ", wo.z " + std::to_string(wo.z);
}

}  // namespace mis
