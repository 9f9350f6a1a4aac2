#pragma once

#include "mis/technique/technique.h"

namespace mis {

/// The BSDF's own draw.
struct BrdfTechnique {
    static constexpr std::string_view name = "brdf";
    static constexpr std::string_view summary = "the BSDF's own draw";
    static constexpr bool ranked_by_default(std::size_t, bool) { return true; }
    static constexpr bool chooses_light = false, asks_bsdf = true;
    template <class B, class T>
    MIS_INLINE static Vec3<T> sample(const B& bsdf, const Vec3<T>& wo, const T& lobe,
                                     const Vec2<T>& u)
    {
        return bsdf.sample(wo, lobe, u);
    }
    /// bsdf_pdf: the BSDF's density at wi.
    template <class T> MIS_INLINE static T pdf(const T& bsdf_pdf, const Vec3<T>&)
    {
        return bsdf_pdf;
    }
    template <class B> static bool draws(const B& bsdf) { return bsdf.draws(); }
};

}  // namespace mis
