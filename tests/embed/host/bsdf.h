#pragma once

#include "vec.h"

#include <algorithm>

namespace host {

/// How a surface scatters. Unit directions in the surface's frame (z is the normal), away from it,
/// with wo.z > 0.
class Bsdf {
public:
    virtual ~Bsdf() = default;
    virtual Vec evaluate(const Vec& wo, const Vec& wi) const = 0;  ///< 1/sr, without the cosine
    virtual float pdf(const Vec& wo, const Vec& wi) const = 0;     ///< of sample(), 1/sr
    /// From three numbers in [0, 1); wi.z ≤ 0 is a lost draw.
    virtual Vec sample(const Vec& wo, float lobe, float u, float v) const = 0;
};

class Lambert : public Bsdf {
public:
    explicit Lambert(const Vec& albedo) : f_(albedo * (1 / pi)) {}
    Vec evaluate(const Vec&, const Vec&) const override { return f_; }
    float pdf(const Vec&, const Vec& wi) const override { return std::max(wi.z, 0.0F) / pi; }
    Vec sample(const Vec&, float, float u, float v) const override
    {
        const float r = std::sqrt(u), phi = 2 * pi * v;
        return {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - u)};
    }

private:
    Vec f_;
};

/// diffuse/π + specular · (m + 8)/(8π) · cos^m θ_h; each lobe is drawn half of the time.
class Blinn : public Bsdf {
public:
    Blinn(const Vec& diffuse, const Vec& specular, float m)
        : diffuse_(diffuse), peak_(specular * ((m + 8) / (8 * pi))), m_(m)
    {
    }
    Vec evaluate(const Vec& wo, const Vec& wi) const override
    {
        return diffuse_.evaluate(wo, wi) + peak_ * std::pow(unit(wo + wi).z, m_);
    }
    float pdf(const Vec& wo, const Vec& wi) const override
    {
        const Vec h = unit(wo + wi);
        const float half = (m_ + 1) / (2 * pi) * std::pow(h.z, m_);
        return (diffuse_.pdf(wo, wi) + half / (4 * dot(wo, h))) / 2;
    }
    Vec sample(const Vec& wo, float lobe, float u, float v) const override
    {
        if (lobe < 0.5F) return diffuse_.sample(wo, 0, u, v);
        const float cos_h = std::pow(1 - u, 1 / (m_ + 1)), phi = 2 * pi * v;
        const float sin_h = std::sqrt(std::max(0.0F, 1 - cos_h * cos_h));
        const Vec h{sin_h * std::cos(phi), sin_h * std::sin(phi), cos_h};
        return h * (2 * dot(wo, h)) - wo;
    }

private:
    Lambert diffuse_;
    Vec peak_;
    float m_;
};

}  // namespace host
