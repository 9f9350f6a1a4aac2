#pragma once

#include "mis/math/vec.h"

#include <optional>
#include <string>

namespace mis {

/// What a surface is made of, as the scene file says it. `type` is a name of the BSDF registry; a
/// field that the type does not use is 0. Which fields a type reads: docs/scene-format.md.
struct Material {
    std::string name;              ///< in the scene file
    std::string type = "lambert";  ///< of the BSDF registry
    Vec3<double> diffuse{0};       ///< lambert: albedo; lecture: kd; blinn, ggx: diffuse
    Vec3<double> specular{0};      ///< lecture: ks; blinn: specular; ggx: f0
    double exponent = 0;           ///< lecture: m; blinn: exponent
    double alpha = 0;              ///< ggx: roughness, used as it is
    std::optional<double> specular_probability;  ///< s of design §1; unset: the type's own rule
};

}  // namespace mis
