#pragma once

#include "mis/bsdf/bsdf.h"

namespace mis {

/// f = kd + ks · cos^m θ_h, just as the lecture writes it (Iehl 2012): neither lobe is normalised.
class Lecture : public HalfVectorBsdf {
public:
    static constexpr std::string_view name = "lecture";
    explicit Lecture(const Material& material)
        : HalfVectorBsdf{
              material.diffuse, material.specular, material.exponent,
              specular_share(
                  material, luminance(material.specular) * 8 * pi<double> / (material.exponent + 8),
                  luminance(material.diffuse) * pi<double>)}
    {
    }
};
static_assert(Bsdf<Lecture, float>);

}  // namespace mis
