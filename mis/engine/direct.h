#pragma once

#include "mis/engine/direct_lights.h"
#include "mis/engine/draw.h"
#include "mis/engine/union_draw.h"
#include "mis/heuristic/heuristic.h"
#include "mis/technique/technique.h"

#include <cassert>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

namespace mis {

// Direct lighting at one point, for a host's own loop: his rays, his BSDF, his random numbers. The
// same estimate that the pipeline makes of many points, composed by templates; in double, with the
// pipeline's numbers, the two agree to rounding (direct_test.cpp). Nothing here allocates, throws
// or keeps state.

/// The host's BSDF at the point, for one direction to the viewer. Directions are unit vectors in
/// scene axes. evaluate: f in sr⁻¹, RGB, without the cosine. pdf: density of sample(), per
/// steradian. sample: from a number for the lobe and two for the direction, in [0, 1); a direction
/// below the horizon is a lost draw and contributes 0.
// clang-format off
template <class B, class T>
concept HostBsdf = requires(const B& bsdf, const Vec3<T>& wi, const T& lobe, const Vec2<T>& u) {
    { bsdf.evaluate(wi) } -> std::convertible_to<Vec3<T>>;
    { bsdf.pdf(wi) } -> std::convertible_to<T>;
    { bsdf.sample(lobe, u) } -> std::convertible_to<Vec3<T>>;
};

/// The host's shadow ray: does a surface stand before `distance` (scene units) along wi from the
/// point? Lights are none of its business: they hide one another without it.
template <class O, class T>
concept Occluder = requires(const O& is_occluded, const Vec3<T>& wi, const T& distance) {
    { is_occluded(wi, distance) } -> std::convertible_to<bool>;
};

/// A point under a policy: a DirectPoint, or an AnyDirectPoint.
template <class P, class T>
concept ChoosingPoint = std::derived_from<P, PointAmidLights<T>> &&
    requires(const P& point, std::uint64_t bits, LightIndex j) {
    { point.draws_every_light() } -> std::same_as<bool>;
    { point.choose(bits) } -> std::same_as<Choice>;
    { point.probability(j) } -> std::same_as<double>;
};
// clang-format on

/// The random numbers of one light draw and one BSDF draw. All but `choice` are in [0, 1).
template <class T> struct DirectNumbers {
    std::uint64_t choice = 0;  ///< 64 random bits: a float would starve lights where there are many
    Vec2<T> cap{0};            ///< where in the light's cap
    T lobe = 0;                ///< which lobe of the BSDF
    Vec2<T> bsdf{0};           ///< where in the lobe
};

/// One draw, and all that a host's own loop may want of it.
template <class T> struct DirectDraw {
    Vec3<T> radiance{0};  ///< its share of the estimate; 0 where it meets no light or is occluded
    Vec3<T> wi{0};        ///< unit
    LightIndex light = no_light;  ///< drawn, or met
    T distance = 0;               ///< to the light, scene units
    T light_pdf = 0;              ///< per steradian, with the light's probability in it
    T bsdf_pdf = 0;               ///< per steradian
    T weight = 0;                 ///< of the heuristic
};

/// What a draw is worth where the host's answers make no sense (a direction or a density that is no
/// number, a density below 0): no number, which DirectSample counts.
template <class T> Vec3<T> no_radiance() { return Vec3<T>(std::numeric_limits<T>::quiet_NaN()); }

/// The estimate of one sample. invalid: draws that were not finite (a BSDF that says NaN); they
/// count as 0. At a point that is nowhere (NaN) it is 1.
template <class T> struct DirectSample {
    Vec3<T> radiance{0};  ///< RGB, W·sr⁻¹·m⁻²
    int invalid = 0;      ///< draws

    /// Adds a draw, or counts it as invalid.
    void add(const DirectDraw<T>& draw)
    {
        const Vec3<T>& r = draw.radiance;
        if (std::isfinite(r.x + r.y + r.z)) radiance += r;
        else ++invalid;
    }
};

/// A draw towards a light that was chosen with some probability.
template <class Heuristic, class Technique, class Point, class T = typename Point::Number>
requires ChoosingPoint<Point, T> DirectDraw<T> draw_towards(const Point& point,
                                                            const HostBsdf<T> auto& bsdf,
                                                            const Occluder<T> auto& is_occluded,
                                                            const Choice& choice, const Vec2<T>& u,
                                                            const DirectCounts<T>& counts)
{
    DirectDraw<T> result;
    if (choice.light < 0 || !(choice.probability > 0)) return result;
    const Light& light = point.light(choice.light);
    const Cap<T> cap = point.cap(choice.light);
    assert(!(u.x < 0 || u.x >= 1 || u.y < 0 || u.y >= 1) && "numbers.cap: in [0, 1)");
    const CapDraw<T> draw = Technique::draw(cap, point.n(), u);
    const T cos_theta = draw.cos_theta;
    result.wi = draw.wi, result.light = choice.light, result.distance = draw.distance;
    if (!(cos_theta > 0)) {
        if (std::isnan(cos_theta)) result.radiance = no_radiance<T>();
        return result;
    }

    const T probability = static_cast<T>(choice.probability);
    Vec3<T> over_pdf = radiance_over_pdf(vec_cast<T>(light.radiance_radius), cap, draw);
    result.light_pdf = light_density<Technique>(probability, cap, point.n(), cos_theta);
    // Without the rounding to T: a float direction is off by more than a small light is wide.
    const Vec3<double> to_center = light.center - point.x();
    const Vec3<double> exact_wi = exact_direction(to_center, vec_cast<double>(draw.offset));
    const LightHit own = own_hit(choice.light, to_center, light.radius, exact_wi);
    if constexpr (Technique::sums_lights) {
        const double solid_angle = point.solid_angle(choice.light);
        const UnionDraw in_union = draw_in_union(
            point.hierarchy(), point.x(), exact_wi, own, choice.probability / solid_angle,
            [&](LightIndex j) { return point.probability(j); },
            [&](LightIndex j) { return point.solid_angle(j); });
        const auto ratio = static_cast<T>(in_union.ratio);
        result.light_pdf /= ratio;
        if (in_union.nearest.light != choice.light) {
            result.light = in_union.nearest.light;
            result.distance = static_cast<T>(in_union.nearest.distance);
            over_pdf = vec_cast<T>(radiance(point.light(result.light)) * solid_angle);
        }
        over_pdf *= ratio;
    }
    result.bsdf_pdf = static_cast<T>(bsdf.pdf(draw.wi));
    assert(!(result.bsdf_pdf < 0) && "bsdf.pdf: not negative");
    if (!(result.bsdf_pdf >= 0)) {
        result.radiance = no_radiance<T>();
        return result;
    }
    result.weight = weight_of<Heuristic>(0, counts, result.light_pdf, result.bsdf_pdf);
    const Vec3<T> f_cos = Vec3<T>(bsdf.evaluate(draw.wi)) * cos_theta;
    const Vec3<T> share = light_draw_share(f_cos, over_pdf, result.weight, counts, probability);
    if (share == Vec3<T>(0)) return result;
    if constexpr (!Technique::sums_lights)
        if (point.hierarchy().hides(point.x(), exact_wi, own)) return result;
    if (!is_occluded(draw.wi, result.distance)) result.radiance = share;
    return result;
}

/// A draw of the BSDF, which may meet a light.
template <class Heuristic, class Technique, class Point, class T = typename Point::Number>
requires ChoosingPoint<Point, T> DirectDraw<T> draw_bsdf(const Point& point,
                                                         const HostBsdf<T> auto& bsdf,
                                                         const Occluder<T> auto& is_occluded,
                                                         const T& lobe, const Vec2<T>& u,
                                                         const DirectCounts<T>& counts)
{
    DirectDraw<T> result;
    if (!point.is_lit()) return result;
    result.wi = bsdf.sample(lobe, u);
    const T cos_theta = dot(point.n(), result.wi);
    if (!(cos_theta > 0)) {
        if (std::isnan(cos_theta)) result.radiance = no_radiance<T>();
        return result;
    }
    assert(std::abs(dot(result.wi, result.wi) - 1) < T(1e-3) && "bsdf.sample: a unit vector");
    if (!std::isfinite(cos_theta)) {
        result.radiance = no_radiance<T>();
        return result;
    }
    const Vec3<double> wi = normalized(vec_cast<double>(result.wi));
    const LightHit hit = point.hierarchy().nearest(point.x(), wi);
    if (hit.light < 0) return result;
    result.light = hit.light, result.distance = static_cast<T>(hit.distance);
    result.bsdf_pdf = static_cast<T>(bsdf.pdf(result.wi));
    assert(!(result.bsdf_pdf < 0) && "bsdf.pdf: not negative");
    if (!(result.bsdf_pdf > 0)) {
        if (result.bsdf_pdf != 0) result.radiance = no_radiance<T>();
        return result;
    }

    result.light_pdf = light_density<Technique>(static_cast<T>(point.probability(hit.light)),
                                                point.cap(hit.light), point.n(), cos_theta);
    if constexpr (Technique::sums_lights)
        result.light_pdf = union_density(
            point.hierarchy(), point.x(), wi, hit.light, result.light_pdf,
            [&](LightIndex j) { return point.probability(j); },
            [&](LightIndex j) { return point.solid_angle(j); });
    result.weight = weight_of<Heuristic>(1, counts, result.light_pdf, result.bsdf_pdf);
    const Vec3<T> f_cos = Vec3<T>(bsdf.evaluate(result.wi)) * cos_theta;
    const Vec3<T> share = bsdf_draw_share(f_cos, vec_cast<T>(radiance(point.light(hit.light))),
                                          result.weight, counts, result.bsdf_pdf);
    if (share != Vec3<T>(0) && !is_occluded(result.wi, result.distance)) result.radiance = share;
    return result;
}

/// One sample of the multi-sample model (Veach 1997, §9.2.1): light draws and BSDF draws, weighed.
/// numbers(k): those of draw k, a DirectNumbers<T>; light draw k and BSDF draw k may share it, as
/// they read different members. With `all`, every light has `light_draws`, and k runs over them
/// all.
template <class Heuristic, class Technique, class Point, class T = typename Point::Number>
requires ChoosingPoint<Point, T> DirectSample<T> sample_direct(
    const Point& point, const HostBsdf<T> auto& bsdf, const Occluder<T> auto& is_occluded,
    const auto& numbers, int light_draws = 1, int bsdf_draws = 1)
{
    DirectSample<T> sample;
    sample.invalid = point.is_finite() ? 0 : 1;
    if (!point.is_lit()) return sample;
    const DirectCounts<T> counts{T(light_draws), T(bsdf_draws)};
    const auto lights = static_cast<int>(point.light_count());
    const int draws = point.draws_every_light() ? light_draws * lights : light_draws;
    for (int k = 0; k < draws; ++k) {
        const DirectNumbers<T> u = numbers(k);
        const Choice choice =
            point.draws_every_light() ? Choice{k / light_draws, 1} : point.choose(u.choice);
        sample.add(
            draw_towards<Heuristic, Technique>(point, bsdf, is_occluded, choice, u.cap, counts));
    }
    for (int k = 0; k < bsdf_draws; ++k) {
        const DirectNumbers<T> u = numbers(k);
        sample.add(
            draw_bsdf<Heuristic, Technique>(point, bsdf, is_occluded, u.lobe, u.bsdf, counts));
    }
    return sample;
}

/// One sample of the one-sample model (Veach 1997, §9.2.4): a light draw or a BSDF draw,
/// probability ½ each, by `technique` in [0, 1).
template <class Heuristic, class Technique, class Point, class T = typename Point::Number>
requires ChoosingPoint<Point, T> DirectSample<T> sample_direct_once(
    const Point& point, const HostBsdf<T> auto& bsdf, const Occluder<T> auto& is_occluded,
    const T& technique, const DirectNumbers<T>& u)
{
    static_assert(
        !requires { requires Point::draws_every_light(); },
        "one draw cannot be one for every light");
    assert(!point.draws_every_light());
    DirectSample<T> sample;
    sample.invalid = point.is_finite() ? 0 : 1;
    if (!point.is_lit()) return sample;
    const DirectCounts<T> halves{T(0.5), T(0.5)};
    if (technique < T(0.5))
        sample.add(draw_towards<Heuristic, Technique>(point, bsdf, is_occluded,
                                                      point.choose(u.choice), u.cap, halves));
    else
        sample.add(
            draw_bsdf<Heuristic, Technique>(point, bsdf, is_occluded, u.lobe, u.bsdf, halves));
    return sample;
}

}  // namespace mis
