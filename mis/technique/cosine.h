#pragma once

#include "mis/technique/technique.h"

namespace mis {

/// In proportion to the cosine, cos θ/π, whatever the BSDF.
struct CosineTechnique {
    static constexpr std::string_view name = "cosine";
    static constexpr std::string_view summary = "in proportion to the cosine, whatever the BSDF";
    static constexpr bool chooses_light = false, asks_bsdf = false;
    template <class B, class T>
    MIS_INLINE static Vec3<T> sample(const B&, const Vec3<T>&, const T&, const Vec2<T>& u)
    {
        return sample_cosine(u);
    }
    template <class T> MIS_INLINE static T pdf(const T&, const Vec3<T>& wi)
    {
        return cosine_pdf(wi.z);
    }
    template <class B> static bool draws(const B&) { return true; }
};

}  // namespace mis
