#pragma once

#include "mis/bsdf/bsdf.h"
#include "mis/math/frame.h"
#include "mis/sampling/horizon.h"

namespace mis {

/// A BSDF of the registry at a point: directions in scene axes, one direction to the viewer. It is
/// a HostBsdf (engine/direct.h), and an example of one.
template <class B, class T> class FramedBsdf {
public:
    /// n, wo: unit; n·wo > 0. Keeps a reference to the BSDF.
    FramedBsdf(const B& bsdf, const Vec3<T>& n, const Vec3<T>& wo)
        : bsdf_(&bsdf), frame_(frame_around(n)), wo_(frame_.to_local(wo))
    {
    }
    /// f, sr⁻¹, RGB, without the cosine.
    Vec3<T> evaluate(const Vec3<T>& wi) const { return value(wi).f; }
    /// Density of sample(), per steradian.
    T pdf(const Vec3<T>& wi) const { return value(wi).pdf; }
    /// From numbers in [0, 1); below the horizon it is a lost draw.
    Vec3<T> sample(const T& lobe, const Vec2<T>& u) const
    {
        const Vec3<T> local = bsdf_->sample(wo_, lobe, u);
        return kept_above(frame_.to_world(local), frame_.z, local.z);
    }

private:
    BsdfValue<T> value(const Vec3<T>& wi) const
    {
        return bsdf_->evaluate(wo_, frame_.to_local(wi));
    }
    const B* bsdf_;
    Frame<T> frame_;
    Vec3<T> wo_;  ///< in the frame
};

}  // namespace mis
