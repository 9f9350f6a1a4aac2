#pragma once

#include "mis/technique/technique.h"

namespace mis {

/// Uniform over the hemisphere, 1/2π: the lecture's first try.
struct HemisphereTechnique {
    static constexpr std::string_view name = "hemisphere";
    static constexpr std::string_view summary = "uniform over the hemisphere";
    static constexpr bool chooses_light = false, asks_bsdf = false;
    template <class B, class T>
    MIS_INLINE static Vec3<T> sample(const B&, const Vec3<T>&, const T&, const Vec2<T>& u)
    {
        return sample_hemisphere(u);
    }
    template <class T> MIS_INLINE static T pdf(const T&, const Vec3<T>&)
    {
        return hemisphere_pdf<T>();
    }
    template <class B> static bool draws(const B&) { return true; }
};

}  // namespace mis
