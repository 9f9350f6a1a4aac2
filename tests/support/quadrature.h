#pragma once

#include "mis/math/frame.h"

#include <boost/math/quadrature/gauss.hpp>

#include <numbers>
#include <type_traits>

namespace mis {

/// ∫ f over [a, b], by N Gauss–Legendre nodes. f gives a number or a vector.
template <int N = 16, class F> auto integral(double a, double b, const F& f)
{
    using Rule = boost::math::quadrature::gauss<double, N>;
    const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
    std::decay_t<decltype(f(middle))> sum(0);
    for (std::size_t k = 0; k < Rule::abscissa().size(); ++k) {
        const double t = Rule::abscissa()[k], weight = Rule::weights()[k] * half;
        sum += f(middle + half * t) * weight;
        if (t != 0) sum += f(middle - half * t) * weight;
    }
    return sum;
}

/// The nodes and weights of that rule over [0, 1].
template <int N> struct UnitNodes {
    std::array<double, N> node{}, weight{};
    UnitNodes()
    {
        using Rule = boost::math::quadrature::gauss<double, N>;
        static_assert(N % 2 == 0);
        for (std::size_t k = 0; k < N / 2; ++k) {
            const double t = Rule::abscissa()[k], w = Rule::weights()[k] / 2;
            node[2 * k] = 0.5 * (1 + t), node[2 * k + 1] = 0.5 * (1 - t);
            weight[2 * k] = weight[2 * k + 1] = w;
        }
    }
};

/// ∫ f(direction) dω over the cap of directions within 1 − cos θ ≤ one_minus_cos of the unit vector
/// `axis`. Equal steps in azimuth, Gauss–Legendre in 1 − cos θ: exact to rounding for what is
/// smooth over the cap.
template <class F>
auto integral_over_cap(const Vec3<double>& axis, double one_minus_cos, const F& f,
                       int azimuths = 64)
{
    const Frame<double> frame = frame_around(axis);
    return integral<32>(0, one_minus_cos, [&](double v) {
        const double sin_theta = std::sqrt(v * (2 - v)), step = 2 * std::numbers::pi / azimuths;
        std::decay_t<decltype(f(axis))> sum(0);
        for (int k = 0; k < azimuths; ++k)
            sum += f(frame.to_world(
                       {sin_theta * std::cos(k * step), sin_theta * std::sin(k * step), 1 - v})) *
                   step;
        return sum;
    });
}

}  // namespace mis
