#pragma once

#include "mis/math/vec.h"

#include <cmath>
#include <numbers>
#include <random>

namespace mis {

/// Random inputs of tests, the same on every machine.
class Uniforms {
public:
    explicit Uniforms(unsigned seed) : bits_(seed) {}
    /// In [0, 1).
    double operator()() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * (*this)(); }
    double log_between(double low, double high) { return low * std::pow(high / low, (*this)()); }
    int below(int n) { return static_cast<int>((*this)() * n); }
    Vec2<double> pair() { return {between(0, 1), between(0, 1)}; }
    Vec3<double> in_box(double half)
    {
        return {between(-half, half), between(-half, half), between(-half, half)};
    }
    /// Uniform over the sphere.
    Vec3<double> direction()
    {
        const double z = between(-1, 1), phi = between(0, 2 * std::numbers::pi),
                     r = std::sqrt(1 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::mt19937_64 bits_;
};

}  // namespace mis
