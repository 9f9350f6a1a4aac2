#include "tests/support/irradiance.h"

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace mis {

namespace {

using Digits = boost::multiprecision::cpp_bin_float_100;

/// Snyder 1996, §2.2.
double snyder(const Digits& sin_max, const Digits& cos_max, const Digits& cos_beta,
              const Digits& sin_beta)
{
    if (cos_beta >= sin_max)
        return static_cast<double>(boost::math::constants::pi<Digits>() * cos_beta);
    if (cos_beta <= -sin_max) return 0;
    const Digits x = cos_max / sin_max, y = -x * cos_beta / sin_beta;
    const Digits height = cos_beta / sin_max, z = sqrt(1 - height * height);
    return static_cast<double>(cos_beta * acos(y) - x * z + atan(z / x) / (sin_max * sin_max));
}

Digits other_side(const Digits& x) { return sqrt((1 - x) * (1 + x)); }

}  // namespace

double exact_irradiance_over_sin2(double sin_max, double cos_beta)
{
    const Digits s = sin_max, c = cos_beta;
    return snyder(s, other_side(s), c, other_side(c));
}

double exact_irradiance_of_cosines(double cos_max, double sin_beta, bool is_sunken)
{
    const Digits k = cos_max, sine = sin_beta, c = other_side(sine);
    return snyder(other_side(k), k, is_sunken ? Digits(-c) : c, sine);
}

}  // namespace mis
