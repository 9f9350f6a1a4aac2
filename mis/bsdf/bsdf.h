#pragma once

#include "mis/math/stable.h"
#include "mis/sampling/warp.h"
#include "mis/scene/material.h"

#include <cmath>
#include <concepts>
#include <string_view>
#include <type_traits>

namespace mis {

/// A BSDF for one pair of directions.
template <class T> struct BsdfValue {
    Vec3<T> f;  ///< sr⁻¹, RGB; without the cosine
    T pdf;      ///< density of the BSDF's own draws at wi, per steradian
};

/// How f splits, in round figures: for those who must guess what it reflects of a cap.
struct LobeExtent {
    double diffuse = 0;           ///< luminance of f without its lobe, sr⁻¹
    double specular = 0;          ///< of the order of the lobe's albedo over π, sr⁻¹
    double half_solid_angle = 0;  ///< ∫ lobe/peak over half vectors, sr; 0 where there is no lobe
};

/// How a surface scatters. Directions are unit vectors in the shading frame (z is the normal), away
/// from the point, with wo.z > 0. f is a diffuse part, the same for all wi, and a lobe or none.
/// evaluate: for wi.z > 0. sample: from `lobe` and u, in [0, 1); a
/// wi with wi.z ≤ 0 is a lost draw, which contributes 0 and is not redrawn, so ∫pdf over the
/// hemisphere + P(lost) = 1. draws(): false where all is black. has_lobe: false where no material
/// has one, whatever it says. is_diffuse(): this one has none. A type that has a lobe has
/// evaluate_diffuse(wi), its diffuse part alone: where it lacks the lobe, that is evaluate(wo, wi)
/// to the last bit. And lobe_share(): how many of its draws are the lobe's, those with `lobe` below
/// that.
// clang-format off
template <class B, class T>
concept Bsdf = std::constructible_from<B, const Material&> &&
    requires(const B& bsdf, const Vec3<T>& w, const T& lobe, const Vec2<T>& u) {
    { B::name } -> std::convertible_to<std::string_view>;
    { B::has_lobe } -> std::convertible_to<bool>;
    { bsdf.evaluate(w, w) } -> std::same_as<BsdfValue<T>>;
    { bsdf.sample(w, lobe, u) } -> std::same_as<Vec3<T>>;
    { bsdf.draws() } -> std::same_as<bool>;
    { bsdf.is_diffuse() } -> std::same_as<bool>;
    { bsdf.lobe() } -> std::same_as<LobeExtent>;
};
// clang-format on

/// An RGB constant in every lane.
template <class T> MIS_INLINE Vec3<T> color(const Vec3<double>& rgb)
{
    return {number<T>(rgb.x), number<T>(rgb.y), number<T>(rgb.z)};
}

/// The half vector between two directions of the shading frame, by what formulas ask of it.
template <class T> struct HalfVector {
    T sin2, cos2;  ///< of its angle to the normal, each to full relative precision
    T wo_dot_h;
};

template <class T> MIS_INLINE HalfVector<T> half_vector(const Vec3<T>& wo, const Vec3<T>& wi)
{
    using std::sqrt;
    const Vec3<T> sum = wo + wi;
    const T squared = max_of(length2(sum), number<T>(1e-30));
    const T inverse = number<T>(1) / squared;
    return {(square(sum.x) + square(sum.y)) * inverse, square(sum.z) * inverse,
            sqrt(squared) * number<T>(0.5)};
}

/// Draws a half vector ∝ cos^m θ_h and reflects wo about it. Its density: reflected_lobe_pdf.
template <class T>
MIS_INLINE Vec3<T> sample_reflected_lobe(const Vec3<T>& wo, const Vec2<T>& u, double m)
{
    const Vec3<T> h = sample_lobe(u, m);
    return h * (number<T>(2) * dot(wo, h)) - wo;
}
template <class T> MIS_INLINE T reflected_lobe_pdf(const T& lobe_value, const T& wo_dot_h, double m)
{
    return number<T>((m + 1) / (8 * 3.14159265358979323846)) * lobe_value / wo_dot_h;
}

/// s of design §1: the probability of drawing from the specular lobe; a black lobe has 0 unless the
/// scene says so. Rounded up to a multiple of 2⁻³², the step of a random number, which matters
/// below 1e-4: a small s then is the probability of what it says to the last bit.
inline double specular_share(const Material& material, double specular, double diffuse)
{
    const double s =
        material.specular_probability.value_or(specular > 0 ? specular / (specular + diffuse) : 0);
    return std::ceil(s * 0x1p32) * 0x1p-32;
}

/// A BSDF of a diffuse lobe and a lobe cos^m θ_h about the half vector:
/// f = diffuse + specular · cos^m θ_h, drawn from the lobe with probability s.
struct HalfVectorBsdf {
    static constexpr bool has_lobe = true;

    Vec3<double> diffuse, specular;  ///< sr⁻¹
    double m, s;

    template <class T> MIS_INLINE BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const
    {
        const HalfVector<T> h = half_vector(wo, wi);
        const T lobe = pow_cos(h.sin2, h.cos2, m);
        return {color<T>(diffuse) + color<T>(specular) * lobe,
                number<T>(1 - s) * cosine_pdf(wi.z) +
                    number<T>(s) * reflected_lobe_pdf(lobe, h.wo_dot_h, m)};
    }
    template <class T> MIS_INLINE BsdfValue<T> evaluate_diffuse(const Vec3<T>& wi) const
    {
        return {color<T>(diffuse), cosine_pdf(wi.z)};
    }
    bool is_diffuse() const { return specular == Vec3<double>(0) && s <= 0; }
    template <class T>
    MIS_INLINE Vec3<T> sample(const Vec3<T>& wo, const T& lobe, const Vec2<T>& u) const
    {
        if (s <= 0) return sample_cosine(u);
        const Vec3<T> specular_wi = sample_reflected_lobe(wo, u, m), diffuse_wi = sample_cosine(u);
        const auto is_specular = lobe < number<T>(s);
        return {select(is_specular, specular_wi.x, diffuse_wi.x),
                select(is_specular, specular_wi.y, diffuse_wi.y),
                select(is_specular, specular_wi.z, diffuse_wi.z)};
    }
    bool draws() const { return luminance(diffuse) > 0 || luminance(specular) > 0; }
    double lobe_share() const { return s; }
    MIS_INLINE LobeExtent lobe() const
    {
        const double strength = luminance(specular);
        return {luminance(diffuse), strength * 8 / (m + 8),
                strength > 0 ? 2 * pi<double> / (m + 1) : 0};
    }
};

/// What of B is evaluated and drawn. BSDFs by the half vector differ in what they make of a
/// material alone: kernels know one type for all of them.
template <class B>
using FormulaOf = std::conditional_t<std::is_base_of_v<HalfVectorBsdf, B>, HalfVectorBsdf, B>;

}  // namespace mis
