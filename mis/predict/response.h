#pragma once

#include "mis/bsdf/bsdf.h"
#include "mis/math/frame.h"
#include "mis/predict/rule.h"
#include "mis/scene/scene.h"

#include <functional>

namespace mis {

/// What the surface does with light from one direction; all 0 below the horizon.
struct ResponseValue {
    Vec3<double> f{0};  ///< sr⁻¹, RGB; without the cosine
    double pdf = 0;     ///< of the BSDF's own draws, per steradian
    double cos_theta = 0;
};

/// The BSDF of a probe, its name known at run time.
class Response {
public:
    Response(const Material& material, const Vec3<double>& n, const Vec3<double>& wo);

    /// wi: unit, world.
    ResponseValue at(const Vec3<double>& wi) const;
    bool draws() const { return draws_; }  ///< false where all is black
    const Vec3<double>& normal() const { return frame_.z; }
    const Vec3<double>& outgoing() const { return wo_; }
    Vec3<double> to_local(const Vec3<double>& wi) const { return frame_.to_local(wi); }

private:
    Frame<double> frame_;
    Vec3<double> wo_, wo_local_;
    std::function<BsdfValue<double>(const Vec3<double>& wo, const Vec3<double>& wi)> evaluate_;
    bool draws_ = false;
};

}  // namespace mis
