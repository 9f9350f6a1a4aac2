#pragma once

#include "mis/bsdf/bsdf.h"

namespace mis {

/// f = diffuse/π + D·G2·F/(4 (n·wi)(n·wo)): isotropic GGX (Walter et al. 2007), height-correlated
/// Smith masking (Heitz 2014, eq. 99), Schlick's Fresnel term, visible normals drawn (Heitz 2018,
/// "Sampling the GGX Distribution of Visible Normals", JCGT 7(4)).
class Ggx {
public:
    static constexpr std::string_view name = "ggx";
    static constexpr bool has_lobe = true;
    explicit Ggx(const Material& material)
        : diffuse_(material.diffuse / pi<double>), f0_(material.specular), alpha_(material.alpha),
          s_(specular_share(material, specular_weight(material), luminance(material.diffuse)))
    {
    }

    template <class T> MIS_INLINE BsdfValue<T> evaluate(const Vec3<T>& wo, const Vec3<T>& wi) const
    {
        const HalfVector<T> h = half_vector(wo, wi);
        const T a2 = number<T>(alpha_ * alpha_);
        const T d = a2 / (T(pi<T>) * square(a2 * h.cos2 + h.sin2));
        const T smith_o = smith(wo.z), smith_i = smith(wi.z);
        const T reflected =
            d * number<T>(0.5) / (wo.z * smith_i + wi.z * smith_o);  // D·G2/(4 (n·wi)(n·wo))
        // 1 − wo·h, which cancels near normal incidence, from |wo − wi| (docs/theory.md, eq. 19).
        const T away = length2(wo - wi) * number<T>(0.25) / (number<T>(1) + h.wo_dot_h);
        const T fresnel = square(square(away)) * away;
        const Vec3<T> f0 = color<T>(f0_);
        const Vec3<T> schlick = f0 + (Vec3<T>(number<T>(1)) - f0) * fresnel;
        const T specular_pdf = d * number<T>(0.5) / (wo.z + smith_o);  // D·G1(wo)/(4 n·wo)
        return {color<T>(diffuse_) + schlick * reflected,
                number<T>(1 - s_) * cosine_pdf(wi.z) + number<T>(s_) * specular_pdf};
    }

    template <class T> MIS_INLINE BsdfValue<T> evaluate_diffuse(const Vec3<T>& wi) const
    {
        return {color<T>(diffuse_), cosine_pdf(wi.z)};
    }

    template <class T>
    MIS_INLINE Vec3<T> sample(const Vec3<T>& wo, const T& lobe, const Vec2<T>& u) const
    {
        const Vec3<T> h = sample_visible_normal(wo, u);
        const Vec3<T> specular_wi = h * (number<T>(2) * dot(wo, h)) - wo,
                      diffuse_wi = sample_cosine(u);
        const auto is_specular = lobe < number<T>(s_);
        return {select(is_specular, specular_wi.x, diffuse_wi.x),
                select(is_specular, specular_wi.y, diffuse_wi.y),
                select(is_specular, specular_wi.z, diffuse_wi.z)};
    }

    bool draws() const { return true; }  // at grazing angles F is 1, whatever f0
    double lobe_share() const { return s_; }
    bool is_diffuse() const { return false; }
    MIS_INLINE LobeExtent lobe() const
    {
        const double y = luminance(f0_);
        return {luminance(diffuse_), (y > 0 ? y : 1.0 / 21) / pi<double>,
                pi<double> * alpha_ * alpha_};
    }

private:
    /// Y(f0); where that is 0 the lobe still reflects, by Schlick's hemispherical mean (1 − f0)/21.
    static double specular_weight(const Material& material)
    {
        const double y = luminance(material.specular);
        return y > 0 ? y : 1.0 / 21;
    }

    /// √(α² + (1 − α²) cos²θ): G1 = 2 cos θ/(cos θ + this).
    template <class T> MIS_INLINE T smith(const T& cos_theta) const
    {
        using std::sqrt;
        const double a2 = alpha_ * alpha_;
        return sqrt(number<T>(a2) + number<T>(1 - a2) * square(cos_theta));
    }

    template <class T>
    MIS_INLINE Vec3<T> sample_visible_normal(const Vec3<T>& wo, const Vec2<T>& u) const
    {
        using std::sqrt;
        const T alpha = number<T>(alpha_), one = number<T>(1);
        const Vec3<T> stretched = normalized(Vec3<T>{wo.x * alpha, wo.y * alpha, wo.z});
        const T across2 = square(stretched.x) + square(stretched.y);
        const auto tilted = across2 > number<T>(1e-30);
        const T inverse = one / sqrt(max_of(across2, number<T>(1e-30)));
        const Vec3<T> t1{select(tilted, -stretched.y * inverse, one),
                         select(tilted, stretched.x * inverse, number<T>(0)), number<T>(0)};
        const Vec3<T> t2 = cross(stretched, t1);
        const T r = sqrt(u.x);
        const OnCircle<T> azimuth = on_circle(u.y);
        const T p1 = r * azimuth.cos;
        const T tilt = number<T>(0.5) * (one + stretched.z);
        const T p2 =
            (one - tilt) * sqrt(max_of(one - square(p1), number<T>(0))) + tilt * (r * azimuth.sin);
        const T p3 = sqrt(max_of(one - square(p1) - square(p2), number<T>(0)));
        const Vec3<T> visible = t1 * p1 + t2 * p2 + stretched * p3;
        return normalized(
            Vec3<T>{visible.x * alpha, visible.y * alpha, max_of(visible.z, number<T>(0))});
    }

    Vec3<double> diffuse_;  ///< sr⁻¹
    Vec3<double> f0_;
    double alpha_, s_;
};
static_assert(Bsdf<Ggx, float>);

}  // namespace mis
