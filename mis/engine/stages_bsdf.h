#pragma once

#include "mis/engine/draw.h"
#include "mis/engine/rows.h"
#include "mis/sampling/horizon.h"

namespace mis {
inline namespace MIS_ISA {

// The BSDF: evaluated for both halves, drawn from in its own.

/// With its lobe, or without one where its type can lack it.
template <bool lobe, class B, class V>
MIS_INLINE BsdfValue<V> value_of(const B& bsdf, const Vec3<V>& wo, const Vec3<V>& wi)
{
    if constexpr (!lobe && requires { bsdf.evaluate_diffuse(wi); })
        return bsdf.evaluate_diffuse(wi);
    else return bsdf.evaluate(wo, wi);
}

/// wi, cos_theta → contribution (f cos θ) and bsdf_pdf; both 0 below the horizon. With a lobe, or
/// what is left where a BSDF has none; with a horizon, or where no wi is below it.
template <class V, class B, bool lobe, bool horizon, class T>
void evaluate_bsdf(const TileJob<T>& job, Batch<T>& batch)
{
    const B& bsdf = *static_cast<const B*>(job.bsdf);
    const V zero = number<V>(0);
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const Frame<V> frame = frame_around(batch.n.template get<V>(row));
        Vec3<V> wi = frame.to_local(batch.wi.template get<V>(row));
        wi.z = lanes_of<V>(batch.cos_theta, row);
        const auto above = wi.z > zero;
        if constexpr (horizon) wi.z = select(above, wi.z, number<V>(1));
        const BsdfValue<V> value = value_of<lobe>(bsdf, batch.wo.template get<V>(row), wi);
        Vec3<V> f_cos = value.f * wi.z;
        V pdf = value.pdf;
        if constexpr (horizon) {
            f_cos = zero_unless(above, f_cos);
            pdf = select(above, pdf, zero);
        }
        batch.contribution.set(row, f_cos);
        set_lanes(batch.bsdf_pdf, row, pdf);
    });
}

/// evaluate_bsdf and weigh_light in one, where the BSDF draws are the lobe's alone: of a light
/// draw, the diffuse part counts in full, and the lobe by its weight. docs/theory.md, eq. 95.
template <class V, class B, class Heuristic, class T>
void weigh_parts(const TileJob<T>& job, Batch<T>& batch)
{
    const B &bsdf = *static_cast<const B*>(job.bsdf), &lobe = *static_cast<const B*>(job.lobe);
    const DirectCounts<V> of_technique{V(job.light_count), V(job.bsdf_count)};
    const V zero = number<V>(0), one = number<V>(1);
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const Frame<V> frame = frame_around(batch.n.template get<V>(row));
        Vec3<V> wi = frame.to_local(batch.wi.template get<V>(row));
        const V cos_theta = lanes_of<V>(batch.cos_theta, row);
        const V probability = lanes_of<V>(batch.probability, row);
        const auto counts = cos_theta > zero && probability > zero;
        wi.z = select(counts, cos_theta, one);
        const BsdfValue<V> of_lobe = lobe.evaluate(batch.wo.template get<V>(row), wi);
        const V weight = weight_of<Heuristic>(0, of_technique, V(lanes_of<V>(batch.light_pdf, row)),
                                              of_lobe.pdf);
        const Vec3<V> f_cos = (bsdf.evaluate_diffuse(wi).f + of_lobe.f * weight) * wi.z;
        const Vec3<V> share = light_draw_share(f_cos, batch.radiance.template get<V>(row), one,
                                               of_technique, V(select(counts, probability, one)));
        batch.contribution.set(row, zero_unless(counts, share));
    });
}

/// What a technique is given that does not ask the BSDF.
struct NoBsdf {};

/// lobe, u, v → wi, cos_theta. A draw below the horizon is lost: wi = 0.
template <class V, class B, class Technique, class T>
void draw_direction(const TileJob<T>& job, Batch<T>& batch)
{
    const B& bsdf = *static_cast<const B*>(job.bsdf);
    const bool draws = Technique::draws(bsdf);
    const V zero = number<V>(0);
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const Vec2<V> u{lanes_of<V>(batch.u, row), lanes_of<V>(batch.v, row)};
        const Vec3<V> local = Technique::sample(bsdf, batch.wo.template get<V>(row),
                                                V(lanes_of<V>(batch.lobe, row)), u);
        const Vec3<V> n = batch.n.template get<V>(row);
        const V keep = draws ? select(local.z > zero, number<V>(1), zero) : zero;
        const Vec3<V> wi = kept_above(frame_around(n).to_world(local), n, local.z) * keep;
        batch.wi.set(row, wi);
        set_lanes(batch.cos_theta, row, V(dot(n, wi)));
    });
}

/// bsdf_pdf, cos_theta → pdf of the technique that drew wi.
template <class V, class Technique, class T>
void pdf_of_direction(const TileJob<T>&, Batch<T>& batch)
{
    for_each_lane_group<V>(batch.rows, [&](int row) {
        Vec3<V> wi =
            frame_around(batch.n.template get<V>(row)).to_local(batch.wi.template get<V>(row));
        wi.z = lanes_of<V>(batch.cos_theta, row);
        set_lanes(batch.bsdf_pdf, row, V(Technique::pdf(V(lanes_of<V>(batch.bsdf_pdf, row)), wi)));
    });
}

/// contribution (f cos θ), radiance, densities → contribution (share of the estimate).
template <class V, class Heuristic, class T> void weigh_bsdf(const TileJob<T>& job, Batch<T>& batch)
{
    const DirectCounts<V> of_technique{V(job.light_count), V(job.bsdf_count)};
    const V zero = number<V>(0);
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const V pdf = lanes_of<V>(batch.bsdf_pdf, row);
        const V weight =
            weight_of<Heuristic>(1, of_technique, V(lanes_of<V>(batch.light_pdf, row)), pdf);
        const Vec3<V> share =
            bsdf_draw_share(batch.contribution.template get<V>(row),
                            batch.radiance.template get<V>(row), weight, of_technique, pdf);
        const auto counts = pdf > zero;
        batch.contribution.set(row, zero_unless(counts, share));
    });
}

/// The same where the direction technique is alone.
template <class V, class T> void weigh_alone(const TileJob<T>&, Batch<T>& batch)
{
    const V zero = number<V>(0);
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const V pdf = lanes_of<V>(batch.bsdf_pdf, row);
        const Vec3<V> share =
            batch.contribution.template get<V>(row) * batch.radiance.template get<V>(row) / pdf;
        const auto counts = pdf > zero;
        batch.contribution.set(row, zero_unless(counts, share));
    });
}

}  // namespace MIS_ISA
}  // namespace mis
