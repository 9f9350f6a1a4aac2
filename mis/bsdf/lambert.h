#pragma once

#include "mis/bsdf/bsdf.h"

namespace mis {

/// f = albedo/π, drawn by the cosine.
class Lambert {
public:
    static constexpr std::string_view name = "lambert";
    static constexpr bool has_lobe = false;
    explicit Lambert(const Material& material) : f_(material.diffuse / pi<double>) {}

    template <class T> MIS_INLINE BsdfValue<T> evaluate(const Vec3<T>&, const Vec3<T>& wi) const
    {
        return {color<T>(f_), cosine_pdf(wi.z)};
    }
    template <class T> MIS_INLINE Vec3<T> sample(const Vec3<T>&, const T&, const Vec2<T>& u) const
    {
        return sample_cosine(u);
    }
    bool draws() const { return luminance(f_) > 0; }
    bool is_diffuse() const { return true; }
    MIS_INLINE LobeExtent lobe() const { return {luminance(f_), 0, 0}; }

private:
    Vec3<double> f_;  ///< sr⁻¹
};
static_assert(Bsdf<Lambert, float>);

}  // namespace mis
