#pragma once

#include "mis/engine/draw.h"
#include "mis/engine/rows.h"
#include "mis/engine/union_draw.h"
#include "mis/technique/technique.h"

namespace mis {
inline namespace MIS_ISA {

// The light half: numbers → choose → draw in the cap → BSDF → weigh → occlusion → add. V is the
// lanes' type, T its number.

/// Asks for a light's record ahead of its use: of a million, most are in no cache.
template <class T> MIS_INLINE void fetch_ahead(const TileJob<T>& job, LightIndex light)
{
    const auto* record = reinterpret_cast<const std::byte*>(job.lights->data() + light);
    __builtin_prefetch(record);
    __builtin_prefetch(record + sizeof(Light) - 1);  // it may begin near the end of a line
}

/// bits → light, probability. Reads the tables that prepare left. L: lanes of double.
template <class L, class Policy, class Table, class T>
void choose_light(const TileJob<T>& job, Batch<T>& batch)
{
    const auto rows = static_cast<std::size_t>(batch.rows);
    const bool is_far = job.lights->size() > 256;  // else records are in the first-level cache
    const auto put = [&](std::size_t i, const Choice& choice) __attribute__((always_inline))
    {
        batch.light[i] = job.light_at(choice.light);
        batch.probability[i] = static_cast<T>(choice.probability);
        if (is_far && choice.light >= 0) fetch_ahead(job, batch.light[i]);
    };
    const auto table = [&](std::size_t i) __attribute__((always_inline))->const Table&
    {
        return table_of<Table>(batch, batch.point[i]);
    };
    if constexpr (Policy::draws_every_light) {
        std::fill_n(batch.light.begin(), rows,
                    static_cast<LightIndex>(batch.draw / job.draws_per_light));
        std::fill_n(batch.probability.begin(), rows, T(1));
    } else if constexpr (requires { Policy::draws_go_together; }) {
        Table::template choose_each<batch_capacity>(std::span(batch.bits).first(rows), table, put);
    } else if constexpr (requires(const Table& t) {
                             t.template choose_many<L>(std::span<const std::uint64_t>{}, put);
                         }) {
        for_each_run(
            batch, [&](int first, int end) __attribute__((always_inline)) {
                const auto begin = static_cast<std::size_t>(first);
                table(begin).template choose_many<L>(
                    std::span<const std::uint64_t>(batch.bits)
                        .subspan(begin, static_cast<std::size_t>(end - first)),
                    [&](std::size_t i, const Choice& choice)
                        __attribute__((always_inline)) { put(begin + i, choice); });
            });
    } else {
        for (std::size_t i = 0; i < rows; ++i) put(i, table(i).choose(batch.bits[i]));
    }
}

/// choose_light where there is one light, which no bits change.
template <class Policy, class Table, class T>
void choose_only_light(const TileJob<T>&, Batch<T>& batch)
{
    for_each_run(
        batch, [&](int first, int end) __attribute__((always_inline)) {
            Choice choice{0, 1};
            if constexpr (!Policy::draws_every_light)
                choice =
                    table_of<Table>(batch, batch.point[static_cast<std::size_t>(first)]).choose(0);
            const auto probability = static_cast<T>(choice.probability);
            for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(end); ++i)
                batch.light[i] = choice.light, batch.probability[i] = probability;
        });
}

/// light → probability: for a light that another technique met.
template <class Table, class T> void price_light(const TileJob<T>& job, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        batch.probability[i] = static_cast<T>(
            table_of<Table>(batch, batch.point[i]).probability(job.place_of(batch.light[i])));
    }
}

/// radiance · radius of the rows' lights, scaled where floats want that (radiance_scale.h).
template <class T> void scale_radiance(const TileJob<T>& job, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row) {
        const LightIndex j = batch.light[static_cast<std::size_t>(row)];
        if (j < 0) continue;
        const Light& light = job.light(j);
        batch.radiance.put(
            row, vec_cast<T>(vec_cast<double>(light.radiance_radius) * job.radiance_scale));
    }
}

/// light → to_center, radius, gap2, and radiance · radius in `radiance`. One packed record per row,
/// in double until the difference is taken. A row without a light gets a black one.
template <class T> void fetch_light(const TileJob<T>& job, Batch<T>& batch)
{
    const auto leave_black = [&](int row) {
        const auto i = static_cast<std::size_t>(row);
        batch.to_center.put(row, {0, 0, 1});
        batch.radius[i] = T(0.5), batch.gap2[i] = T(0.75), batch.probability[i] = 0;
        batch.radiance.put(row, Vec3<T>(T(0)));
    };
    for_each_run(
        batch, [&](int first, int end) __attribute__((always_inline)) {
            const Vec3<double> x = shading_point(job, batch, first).x;
            for (int row = first; row < end; ++row) {
                const auto i = static_cast<std::size_t>(row);
                if (batch.light[i] < 0) {
                    leave_black(row);
                    continue;
                }
                const Light& light = job.light(batch.light[i]);
                const Vec3<double> to_center = light.center - x;
                batch.to_center.put(row, vec_cast<T>(to_center));
                batch.radius[i] = static_cast<T>(light.radius);
                batch.gap2[i] = static_cast<T>(gap2_of(to_center, light.radius));
                batch.radiance.put(row, vec_cast<T>(light.radiance_radius));
            }
        });
    if (job.radiance_scale != 1) scale_radiance(job, batch);
    for (int row = batch.rows; row < (batch.rows + 15) / 16 * 16; ++row) {
        leave_black(row);
        batch.n.put(row, {0, 0, 1}), batch.wo.put(row, {0, 0, 1});
    }
}

template <class V, class T> MIS_INLINE Cap<V> cap_of_row(const Batch<T>& batch, int row)
{
    return cap_of_light(batch.to_center.template get<V>(row), lanes_of<V>(batch.radius, row),
                        lanes_of<V>(batch.gap2, row));
}

/// light, u, v → wi, offset, cos_theta, distance, light_pdf, radiance over the pdf of the cap.
template <class V, class Technique, class T> void draw_light(const TileJob<T>& job, Batch<T>& batch)
{
    fetch_light(job, batch);
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const Cap<V> cap = cap_of_row<V>(batch, row);
        const Vec2<V> u{lanes_of<V>(batch.u, row), lanes_of<V>(batch.v, row)};
        const Vec3<V> n = batch.n.template get<V>(row);
        const CapDraw<V> draw = Technique::draw(cap, n, u);
        batch.wi.set(row, draw.wi);
        batch.offset.set(row, draw.offset);
        set_lanes(batch.cos_theta, row, draw.cos_theta);
        set_lanes(batch.distance, row, draw.distance);
        set_lanes(batch.light_pdf, row,
                  light_density<Technique>(V(lanes_of<V>(batch.probability, row)), cap, n,
                                           draw.cos_theta));
        batch.radiance.set(row, radiance_over_pdf(batch.radiance.template get<V>(row), cap, draw));
    });
}

/// light, cos_theta → light_pdf, and the radiance of the light in `radiance`: for a direction that
/// another technique drew.
template <class V, class Technique, class T>
void pdf_of_light(const TileJob<T>& job, Batch<T>& batch)
{
    fetch_light(job, batch);
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const Cap<V> cap = cap_of_row<V>(batch, row);
        const Vec3<V> n = batch.n.template get<V>(row);
        set_lanes(batch.light_pdf, row,
                  light_density<Technique>(V(lanes_of<V>(batch.probability, row)), cap, n,
                                           V(lanes_of<V>(batch.cos_theta, row))));
        const V inverse_radius = number<V>(1) / cap.radius;
        batch.radiance.set(row, Vec3<V>(batch.radiance.template get<V>(row) * inverse_radius));
    });
}

/// contribution (f cos θ), densities → contribution (share of the estimate). `radiance` is over the
/// cap's pdf here.
template <class V, class Heuristic, class T>
void weigh_light(const TileJob<T>& job, Batch<T>& batch)
{
    const DirectCounts<V> of_technique{V(job.light_count), V(job.bsdf_count)};
    const V zero = number<V>(0);
    for_each_lane_group<V>(batch.rows, [&](int row) {
        const V probability = lanes_of<V>(batch.probability, row);
        const auto counts = probability > zero;
        const V weight = weight_of<Heuristic>(0, of_technique, V(lanes_of<V>(batch.light_pdf, row)),
                                              V(lanes_of<V>(batch.bsdf_pdf, row)));
        const Vec3<V> share = light_draw_share(
            batch.contribution.template get<V>(row), batch.radiance.template get<V>(row), weight,
            of_technique, V(select(counts, probability, number<V>(1))));
        batch.contribution.set(row, zero_unless(counts, share));
    });
}

/// The union's density for a light draw, and the radiance of the nearest light.
template <class Table, class T> void sum_light_draw(const TileJob<T>& job, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        const LightIndex chosen = batch.light[i];
        if (chosen < 0) continue;
        const Table& table = table_of<Table>(batch, batch.point[i]);
        const Vec3<double> x = shading_point(job, batch, row).x;
        const Vec3<double> wi = exact_direction(job, batch, row);
        const double solid_angle = solid_angle_from(x, job.light(chosen));
        const UnionDraw in_union = draw_in_union(
            *job.hierarchy, x, wi, own_hit(job, batch, row, wi),
            static_cast<double>(batch.probability[i]) / solid_angle,
            [&](LightIndex j) { return table.probability(job.place_of(j)); },
            [&](LightIndex j) { return solid_angle_from(x, job.light(j)); });
        const auto ratio = static_cast<T>(in_union.ratio);
        batch.light_pdf[i] /= ratio;
        if (in_union.nearest.light != chosen) {
            const Vec3<double> seen = radiance(job.light(in_union.nearest.light));
            batch.radiance.put(row, vec_cast<T>(seen * (solid_angle * job.radiance_scale)));
            batch.distance[i] = static_cast<T>(in_union.nearest.distance);
        }
        batch.radiance.put(row, batch.radiance.at(row) * ratio);
    }
}

/// The union's density for a direction that another technique drew.
template <class Table, class T> void sum_bsdf_draw(const TileJob<T>& job, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        const Table& table = table_of<Table>(batch, batch.point[i]);
        const Vec3<double> x = shading_point(job, batch, row).x;
        batch.light_pdf[i] = union_density(
            *job.hierarchy, x, unit_direction(batch, row), batch.light[i], batch.light_pdf[i],
            [&](LightIndex j) { return table.probability(job.place_of(j)); },
            [&](LightIndex j) { return solid_angle_from(x, job.light(j)); });
    }
}

}  // namespace MIS_ISA
}  // namespace mis
