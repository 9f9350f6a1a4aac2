#pragma once

#include "mis/bsdf/any_bsdf.h"
#include "mis/math/frame.h"
#include "mis/policy/seen_irradiance.h"

namespace mis {

/// What a surface reflects to the viewer, over the irradiance that it comes from; the unit is free,
/// but the same for all that one point sees.
template <class T> struct Reflected {
    T flat, lobe;  ///< by the diffuse part; by the lobe, in the mean
};

/// The same of light from directions that are spread.
template <class T> struct SpreadReflected {
    T flat, lobe;
    T lobe_variance;  ///< of the lobe over the directions, over its squared mean; a guess
    T unsure;         ///< what of the lobe some directions may see that are not guessed to
};

/// That of a surface without a lobe.
template <class T> struct FlatReflection {
    MIS_INLINE Reflected<T> of_cap(const TiltedCap<T>&, const T&, const Vec3<T>&) const
    {
        return {number<T>(1), number<T>(0)};
    }
    MIS_INLINE SpreadReflected<T> of_spread(const Vec3<T>&, const T&, const T&) const
    {
        return {number<T>(1), number<T>(0), number<T>(0), number<T>(0)};
    }
};

/// That of f with a lobe.
template <class T, class B> class GlossyReflection {
public:
    /// Keeps a reference to the BSDF.
    MIS_INLINE GlossyReflection(const B& bsdf, const ChoicePoint<Scalar<T>>& point)
        : bsdf_(&bsdf), frame_(frame_around(Vec3<T>{T(point.n.x), T(point.n.y), T(point.n.z)})),
          wo_{T(point.wo.x), T(point.wo.y), T(point.wo.z)}
    {
        using std::sqrt;
        const LobeExtent lobe = bsdf.lobe();
        const T wide = number<T>(lobe.half_solid_angle / (2 * pi<double>));
        extent_ = max_of(T(number<T>(4 * lobe.half_solid_angle) * sqrt(square(wo_.z) + wide)),
                         number<T>(1e-30));
        diffuse_ = number<T>(lobe.diffuse);
        flat_ = number<T>(lobe.diffuse + defensive * lobe.specular);
        peak_ = lobe_at(Vec3<T>{-wo_.x, -wo_.y, max_of(wo_.z, number<T>(1e-4))});
        lobe_reach_ = number<T>(4) * sqrt(extent_ * number<T>(0.5 / pi<double>));
    }

    /// The lobe is taken where the cap is nearest to the mirror direction; of a cap wider than the
    /// lobe, the lobe meets a part. irradiance: E/sin²θ_max; to_center: unit, in scene axes.
    /// docs/theory.md, eqs. 62 to 64.
    MIS_INLINE Reflected<T> of_cap(const TiltedCap<T>& cap, const T& irradiance,
                                   const Vec3<T>& to_center) const
    {
        const Vec3<T> wi = nearest_to_mirror(cap, frame_.to_local(to_center));
        const T seen = cap.sin_max * (cap.sin_max * irradiance),
                lobe = max_of(T(extent_ * wi.z), number<T>(1e-37));
        return {flat_, lobe_at(wi) * (lobe / max_of(seen, lobe))};
    }

    /// Of directions about `middle` (unit, in scene axes) that vary by `variance` (rad²) along
    /// either of two axes, none of them farther away than `reach` (rad). docs/theory.md, eqs. 67
    /// and 68.
    MIS_INLINE SpreadReflected<T> of_spread(const Vec3<T>& middle, const T& variance,
                                            const T& reach) const
    {
        using std::sqrt;
        const T one = number<T>(1), inverse_lobe_variance = number<T>(2 * pi<double>) / extent_;
        const T q = min_of(T(variance * inverse_lobe_variance), number<T>(1e12));
        const T wide = one + q, wider = wide + q;
        const T over_both = one / (wide * wider), over_wide = wider * over_both;
        const Vec3<T> mirror{-wo_.x, -wo_.y, wo_.z}, away = frame_.to_local(middle) - mirror;
        Vec3<T> wi = mirror + away * sqrt(over_wide);
        wi.z = max_of(wi.z, number<T>(1e-4));
        const T away2 = length2(away);
        const T slope = min_of(T(away2 * inverse_lobe_variance * (q * over_both)), number<T>(4));
        const T growth = one + slope * (one + slope * number<T>(0.5));  // of exp the first terms
        const T outliers = peak_ * (variance / max_of(T(variance + away2), number<T>(1e-37))),
                tail = outliers * number<T>(outlying);
        const T far_off = reach + lobe_reach_;
        const T unsure = select(away2 > far_off * far_off, number<T>(0),
                                T(outliers * number<T>(outlying_doubt)));
        const Vec3<T> unit_wi = wi * T(one / length(wi));
        return {flat_, max_of(lobe_at(unit_wi), tail) * over_wide,
                wide * wide * (wide * over_both) * growth - one, unsure};
    }

private:
    /// The share of the lobe's albedo that counts as diffuse: where the lobe is taken too low, or
    /// underflows, a light still has a probability.
    static constexpr double defensive = 0.02;
    /// Of power that may stand in the lobe as far as its variance goes, the share that does.
    static constexpr double outlying = 0.03;
    /// And what of their worth that puts in doubt.
    static constexpr double outlying_doubt = 0.3;

    /// Luminance of the lobe alone; finite where a float's range ends, too.
    MIS_INLINE T lobe_at(const Vec3<T>& wi) const
    {
        const T lobe = luminance(bsdf_->evaluate(wo_, wi).f) - diffuse_;
        return min_of(max_of(lobe, number<T>(0)), number<T>(1e20));
    }

    /// The direction of the cap that is nearest to the mirror direction of wo; at the horizon where
    /// it would be below. All in the shading frame.
    MIS_INLINE Vec3<T> nearest_to_mirror(const TiltedCap<T>& cap, const Vec3<T>& axis) const
    {
        const Vec3<T> mirror{-wo_.x, -wo_.y, wo_.z};
        const T cos_away = dot(axis, mirror);
        const Vec3<T> across = mirror - axis * cos_away;
        const T sin_away = max_of(length(across), number<T>(1e-30));
        const Vec3<T> rim = axis * cap.cos_max + across * (cap.sin_max / sin_away);
        const auto is_inside = cos_away >= cap.cos_max;
        return {select(is_inside, mirror.x, rim.x), select(is_inside, mirror.y, rim.y),
                max_of(select(is_inside, mirror.z, rim.z), number<T>(1e-4))};
    }

    const B* bsdf_;
    Frame<T> frame_;
    Vec3<T> wo_;
    T extent_;      ///< the lobe's solid angle about wi
    T lobe_reach_;  ///< four standard deviations of it (rad)
    T diffuse_, flat_, peak_;
};

/// Calls f with what the surface at this point reflects: a FlatReflection or a GlossyReflection.
// Inlined by force, as all that kernels call (docs/theory.md, "Instruction sets").
template <class T, class F>
MIS_INLINE void visit_reflection(const ChoicePoint<Scalar<T>>& point, F&& f)
{
    bool is_glossy = false;
    point.bsdf.visit([&]<class B>(const B& bsdf) __attribute__((always_inline)) {
        if constexpr (B::has_lobe) {
            is_glossy = bsdf.lobe().half_solid_angle > 0;
            if (is_glossy) f(GlossyReflection<T, B>(bsdf, point));
        }
    });
    if (!is_glossy) f(FlatReflection<T>{});
}

/// The weight of a light by what the surface reflects of it: Y(L)·E·reflection. from_origin: of the
/// point, from the origin of the lights' places.
template <class T, class Reflection>
MIS_INLINE T reflected_weight(const Reflection& reflection, const SeenLight<T>& light,
                              const Vec3<T>& n, const T& from_origin)
{
    const TiltedCap<T> cap = light.tilted_cap(n);
    const T irradiance = seen_irradiance_over_sin2(light, cap, from_origin);
    const Reflected<T> reflected =
        reflection.of_cap(cap, irradiance, Vec3<T>(light.to_center * light.inverse_distance()));
    return radiant_irradiance(light, cap, irradiance) * (reflected.flat + reflected.lobe);
}

}  // namespace mis
