#pragma once

#include "mis/math/irradiance.h"

namespace mis {

/// Irradiance per unit radiance of a whole sphere, clipped at the horizon, over sin²θ_max; from sin
/// θ_max and cos β, or, where those are all but 1, from cos θ_max, sin β and the sign of cos β. The
/// textbook's form (Snyder 1996), in a hundred digits, of which it loses up to forty.
double exact_irradiance_over_sin2(double sin_max, double cos_beta);
double exact_irradiance_of_cosines(double cos_max, double sin_beta, bool is_sunken);

/// A cap as the number type T holds it, and the irradiance over sin² of just these numbers: which
/// of each pair is exact, the other follows from it.
template <class T> struct KnownIrradiance {
    TiltedCap<T> cap;
    double over_sin2;
};

template <class T> KnownIrradiance<T> known_by_sines(double sin_max, double cos_beta)
{
    const T s = static_cast<T>(sin_max), c = static_cast<T>(cos_beta);
    const auto cosine_of = [](T sine) {
        const double x = static_cast<double>(sine);
        return static_cast<T>(std::sqrt((1 - x) * (1 + x)));
    };
    return {{s, cosine_of(s), c, cosine_of(c)},
            exact_irradiance_over_sin2(static_cast<double>(s), static_cast<double>(c))};
}

template <class T>
KnownIrradiance<T> known_by_cosines(double cos_max, double sin_beta, bool is_sunken)
{
    KnownIrradiance<T> known = known_by_sines<T>(cos_max, sin_beta);
    TiltedCap<T>& cap = known.cap;
    std::swap(cap.sin_max, cap.cos_max), std::swap(cap.cos_beta, cap.sin_beta);
    if (is_sunken) cap.cos_beta = -cap.cos_beta;
    known.over_sin2 = exact_irradiance_of_cosines(static_cast<double>(cap.cos_max),
                                                  static_cast<double>(cap.sin_beta), is_sunken);
    return known;
}

}  // namespace mis
