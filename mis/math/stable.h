#pragma once

#include "mis/math/vec.h"

#include <limits>

namespace mis {

// Formulas that lose digits when written as in the textbook. What is small (1 − cos θ, sin²θ, d² −
// r²) is what is stored; see docs/theory.md §2.

template <class T> inline constexpr Scalar<T> pi = static_cast<Scalar<T>>(3.14159265358979323846);
template <class T>
inline constexpr Scalar<T> two_pi = static_cast<Scalar<T>>(6.28318530717958647692);

/// A double constant as a number of type T, in every lane.
template <class T> MIS_INLINE T number(double value) { return T(static_cast<Scalar<T>>(value)); }

template <class T> MIS_INLINE T square(const T& x) { return x * x; }

/// 1/x of a number that is not negative, infinite where it is 0: for densities and ratios of which
/// that is meant.
inline double inverse(double x) { return x == 0 ? std::numeric_limits<double>::infinity() : 1 / x; }

/// cos^m θ from sin²θ and cos²θ, each given with its own full precision: exp(−m/2 · log1p(tan²θ)),
/// which is precise near the axis and far from it. m = 0 gives 1 everywhere. Error: 4 ulp · (1 +
/// |ln value|), m up to 1e6 (docs/theory.md, eq. 9).
template <class T> MIS_INLINE T pow_cos(const T& sin2, const T& cos2, double m)
{
    using std::exp, std::log1p;
    const T tan2 = sin2 / max_of(cos2, number<T>(1e-37));
    return exp(number<T>(-0.5 * m) * log1p(tan2));
}

/// 1 − cos θ of a direction drawn with density ∝ cos^m θ, from u in [0, 1): −expm1(log1p(−u)/(m +
/// 1)). Full relative precision for any m (docs/theory.md, eq. 8).
template <class T> MIS_INLINE T one_minus_cos_of_lobe(const T& u, double m)
{
    using std::expm1, std::log1p;
    return -expm1(log1p(-u) * number<T>(1 / (m + 1)));
}

}  // namespace mis
