#pragma once

#include "tests/support/irradiance.h"
#include "tests/support/lanes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mis {

/// Snyder's form as the textbook writes it, in float, over sin²θ_max.
inline double textbook_irradiance_in_float(const TiltedCap<float>& cap)
{
    const float x = std::sqrt(1 / (cap.sin_max * cap.sin_max) - 1);
    const float y = std::clamp(-x * cap.cos_beta / cap.sin_beta, -1.F, 1.F);
    const float z = cap.sin_beta * std::sqrt(1 - y * y), s2 = cap.sin_max * cap.sin_max;
    return static_cast<double>(s2 * (cap.cos_beta * std::acos(y) - x * z) + std::atan(z / x)) /
           static_cast<double>(s2);
}

/// Relative error of irradiance_over_sin2 in the number type T.
template <class T> double irradiance_error(const KnownIrradiance<Scalar<T>>& known)
{
    const auto& c = known.cap;
    const TiltedCap<T> cap{T(c.sin_max), T(c.cos_max), T(c.cos_beta), T(c.sin_beta)};
    return static_cast<double>(lane(irradiance_over_sin2(cap), 0)) / known.over_sin2 - 1;
}

inline void print_irradiance_row(const KnownIrradiance<float>& known,
                                 const KnownIrradiance<double>& in_double, double height)
{
    const auto& c = in_double.cap;
    fmt::print("| {:.7g} | {:.6f} | {:.4g} | {:+.0e} | {:+.0e} | {:+.0e} | {:+.0e} |\n", c.sin_max,
               height, in_double.over_sin2, irradiance_error<float>(known),
               irradiance_error<TestLanes<float>>(known), irradiance_error<double>(in_double),
               textbook_irradiance_in_float(known.cap) / known.over_sin2 - 1);
}

/// How far E/sin²θ_max is from its closed form in a hundred digits, from a cap that rests on the
/// horizon to tangency from below.
inline void print_irradiance_table()
{
    fmt::print(
        "| sin θ_max | cos β/sin θ_max | E/sin²θ_max | float | float, lanes | double | textbook in "
        "float |\n| ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    for (const double s : {1e-8, 1e-4, 0.01, 0.3, 0.6})
        for (const double height : {1.0, 0.5, 0.0, -0.5, -0.9, -0.999, -0.999999})
            print_irradiance_row(known_by_sines<float>(s, s * height),
                                 known_by_sines<double>(s, s * height), height);
    for (const double cos_max : {0.1, 4.4721359e-4})
        for (const double rise : {5.0, 1.0, 0.1, 1e-3, 1e-6}) {
            const double sin_beta = cos_max * (1 + rise);
            const auto exact = known_by_cosines<double>(cos_max, sin_beta, true);
            print_irradiance_row(known_by_cosines<float>(cos_max, sin_beta, true), exact,
                                 exact.cap.cos_beta / exact.cap.sin_max);
        }
}

}  // namespace mis
