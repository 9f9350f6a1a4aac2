#pragma once

#include "mis/bsdf/bsdf.h"

namespace mis {

/// f = kd/π + ks · (m + 8)/(8π) · cos^m θ_h: the half-vector lobe of Blinn 1977, normalised.
class Blinn : public HalfVectorBsdf {
public:
    static constexpr std::string_view name = "blinn";
    explicit Blinn(const Material& material)
        : HalfVectorBsdf{
              material.diffuse / pi<double>,
              material.specular * ((material.exponent + 8) / (8 * pi<double>)), material.exponent,
              specular_share(material, luminance(material.specular), luminance(material.diffuse))}
    {
    }
};
static_assert(Bsdf<Blinn, float>);

}  // namespace mis
