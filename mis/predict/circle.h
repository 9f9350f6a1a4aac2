#pragma once

#include "mis/math/frame.h"
#include "mis/math/limits.h"

#include <array>
#include <cmath>
#include <limits>

namespace mis {

/// Polar coordinates on the sphere of directions: θ from a pole, φ around it.
/// ω(θ, φ) = pole + offset; the offset keeps its relative precision where θ is tiny.
struct Polar {
    Vec3<double> pole, e1, e2;

    explicit Polar(const Vec3<double>& axis) : pole(axis)
    {
        const Frame<double> frame = frame_around(axis);
        e1 = frame.x, e2 = frame.y;
    }
    Vec3<double> around(double phi) const { return e1 * std::cos(phi) + e2 * std::sin(phi); }
    Vec3<double> offset(const Vec3<double>& around_phi, double theta) const
    {
        const double half_sine = std::sin(theta / 2), half_cosine = std::cos(theta / 2);
        return around_phi * (2 * half_sine * half_cosine) - pole * (2 * half_sine * half_sine);
    }
    double azimuth(const Vec3<double>& w) const { return std::atan2(dot(w, e2), dot(w, e1)); }
};

/// The part of a meridian (0 ≤ τ < ∞, τ = tan θ/2) that lies inside a circle: [low, high], or all
/// but that.
struct Chord {
    double low = 0, high = 0;
    bool inverted = false;
    bool holds(double tau) const { return (low <= tau && tau <= high) != inverted; }
};

/// A circle of directions, projected stereographically from the antipode of the pole, where it is a
/// circle again: a (X² + Y²) − 4 (bx X + by Y) + c ≤ 0 inside, (X, Y) = τ (cos φ, sin φ)
/// (docs/theory-predict.md, P12, P13).
struct Circle {
    double a, bx, by, c;
    double sine = 1;  ///< of its angular radius
    int ball = -1;    ///< whose cap it bounds; −1: the horizon, whose inside is above

    /// The cap about pole + delta.
    static Circle of_cap(const Polar& polar, const Vec3<double>& delta, double one_minus_cos,
                         double sine, int ball)
    {
        const double delta2 = length2(delta);
        return {4 - delta2 - 2 * one_minus_cos,
                dot(delta, polar.e1),
                dot(delta, polar.e2),
                delta2 - 2 * one_minus_cos,
                sine,
                ball};
    }
    /// The half of all directions about `axis`.
    static Circle of_half(const Polar& polar, const Vec3<double>& axis, int ball)
    {
        const double up = dot(axis, polar.pole);
        return {2 * up, dot(axis, polar.e1), dot(axis, polar.e2), -2 * up, 1, ball};
    }

    /// Of the meridian at φ.
    Chord chord(double cos_phi, double sin_phi) const
    {
        const double b = bx * cos_phi + by * sin_phi;
        const double past =
            bx * sin_phi - by * cos_phi;  // how far off the centre the meridian passes
        // b² − ac/4, without cancellation for small circles far from the pole.
        const double root2 = is_great() ? b * b + a * a / 4 : (sine - past) * (sine + past);
        if (root2 < 0) return {infinity, infinity, a < 0 || (a == 0 && c < 0)};
        const double s = 2 * (b + std::copysign(std::sqrt(root2), b));
        if (s == 0) return {0, a <= 0 ? infinity : 0, false};
        double first = c / s, second = a != 0 ? s / a : std::copysign(infinity, s);
        if (a == 0) return s > 0 ? Chord{first, infinity, false} : Chord{first, infinity, true};
        if (first > second) std::swap(first, second);
        return {first, second, a < 0};
    }
    bool is_great() const { return a == -c; }
};

/// A point of the projection plane; NaN where there is none.
struct PlanePoint {
    double phi = std::numeric_limits<double>::quiet_NaN(),
           tau = std::numeric_limits<double>::quiet_NaN();
};

/// Where meridians touch a circle that the pole lies outside of.
std::array<PlanePoint, 2> tangent_points(const Circle& circle);

/// The points that two circles have in common.
std::array<PlanePoint, 2> common_points(const Circle& p, const Circle& q);

}  // namespace mis
