#include "mis/engine/stages_trace.h"

#include "mis/engine/listed_rays.h"
#include "mis/engine/rows.h"
#include "mis/engine/shadow_ray.h"
#include "mis/math/frame.h"
#include "mis/sampling/sobol.h"
#include "mis/trace/intersect.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mis {

namespace {

template <class T> void fill(VecColumn<T>& column, int first, int end, const Vec3<T>& v)
{
    std::fill(column.x.begin() + first, column.x.begin() + end, v.x);
    std::fill(column.y.begin() + first, column.y.begin() + end, v.y);
    std::fill(column.z.begin() + first, column.z.begin() + end, v.z);
}

}  // namespace

template <class T> void start_rows(const TileJob<T>& job, Batch<T>& batch)
{
    if (batch.rows_are_samples) return;  // as the half before left them
    batch.rows_are_samples = true;
    batch.rows = batch.samples;
    batch.runs = 0;
    std::iota(batch.slot.begin(), batch.slot.begin() + batch.rows, 0);
    std::copy_n(batch.sample_point.begin(), batch.rows, batch.point.begin());
    for (int row = 0; row < batch.rows;) {  // the samples of a point stand together
        const std::int32_t p = batch.point[static_cast<std::size_t>(row)];
        int end = row + 1;
        while (end < batch.rows && batch.point[static_cast<std::size_t>(end)] == p) ++end;
        const ShadingPoint& point = shading_point(job, batch, row);
        const Vec3<T> n = vec_cast<T>(point.n);
        fill(batch.x, row, end, vec_cast<T>(point.x - job.origin));
        fill(batch.n, row, end, n);
        fill(batch.wo, row, end, frame_around(n).to_local(vec_cast<T>(point.wo)));
        batch.run_end[static_cast<std::size_t>(batch.runs++)] = row = end;
    }
    const int padded = std::min((batch.rows + 15) / 16 * 16, batch_capacity);
    for (int row = batch.rows; row < padded; ++row) {
        const auto i = static_cast<std::size_t>(row);
        batch.x.put(row, {0, 0, 0});
        batch.n.put(row, {0, 0, 1});
        batch.wo.put(row, {0, 0, 1});
        batch.wi.put(row, {0, 0, 1});
        batch.cos_theta[i] = T(1);
        batch.u[i] = batch.v[i] = batch.lobe[i] = T(0.5);
    }
}

namespace {

/// Rows, ascending.
struct RowList {
    std::array<std::int32_t, batch_capacity + 1> row;  // NOLINT: filled as far as it is read
    std::size_t count = 0;

    /// Without a branch.
    void note(int which, bool is_in) { row[count] = which, count += is_in; }
    int operator[](std::size_t i) const { return row[i]; }
    std::span<const std::int32_t> all() const { return std::span(row).first(count); }
};

/// Moves the kept rows to the front, with all that the later stages of either half read.
template <class T, class Keep> void keep_rows(Batch<T>& batch, const Keep& keep)
{
    batch.rows_are_samples = false;
    RowList kept;
    for (int row = 0; row < batch.rows; ++row) kept.note(row, keep(row));
    batch.rows = static_cast<int>(kept.count);
    for (int to_row = 0; to_row < batch.rows; ++to_row) {
        const auto to = static_cast<std::size_t>(to_row);
        const int row = kept[to];
        if (row == to_row) continue;
        const auto from = static_cast<std::size_t>(row);
        batch.slot[to] = batch.slot[from];
        batch.point[to] = batch.point[from];
        batch.light[to] = batch.light[from];
        batch.distance[to] = batch.distance[from];
        batch.x.put(to_row, batch.x.at(row));
        batch.n.put(to_row, batch.n.at(row));
        batch.wo.put(to_row, batch.wo.at(row));
        batch.wi.put(to_row, batch.wi.at(row));
        batch.cos_theta[to] = batch.cos_theta[from];
    }
}

/// The technique number of a row's sample: the first word of its BSDF block, or that dimension of
/// its sequence.
template <class T> bool draws_light(const TileJob<T>& job, const Batch<T>& batch, int row)
{
    const auto slot = static_cast<std::size_t>(batch.slot[static_cast<std::size_t>(row)]);
    const std::uint32_t id = shading_point(job, batch, row).id;
    const std::uint64_t seed = job.numbers.seed, sample = batch.sample_number[slot];
    std::uint32_t word = 0;
    if (job.numbers.is_sobol()) {
        const SequencePoint at =
            SequencePoint::of(job.numbers.samples_per_scrambling, sample, 1, 0);
        const Words keys = scrambling_keys(seed, id, at, 0, Block::bsdf);
        word = sobol_word(Dimension::technique, static_cast<std::uint32_t>(at.index),
                          keys[key_of::technique]);
    } else {
        word = random_words(seed, {id, sample, 0}, Block::bsdf)[0];
    }
    return word < 0x8000'0000U;
}

}  // namespace

template <class T> void keep_light_rows(const TileJob<T>& job, Batch<T>& batch)
{
    keep_rows(batch, [&](int row) { return draws_light(job, batch, row); });
}

template <class T> void keep_bsdf_rows(const TileJob<T>& job, Batch<T>& batch)
{
    keep_rows(batch, [&](int row) { return !draws_light(job, batch, row); });
}

namespace {

/// Of few lights, screening has ruled out most. Rows for which one light is left are asked of that:
/// ask(row, lights); those with several are noted for the hierarchy.
template <class T, class IsAsked, class Ask>
void ask_screened(const TileJob<T>& job, const Batch<T>& batch, const IsAsked& is_asked,
                  const Ask& ask, RowList& left)
{
    RowList candidates;
    for (int row = 0; row < batch.rows; ++row)
        candidates.note(row, batch.candidate[static_cast<std::size_t>(row)] != 0);
    for (const int row : candidates.all()) {
        if (!is_asked(row)) continue;
        const T candidate = batch.candidate[static_cast<std::size_t>(row)];
        if (candidate < 0) {
            left.note(row, true);
        } else {
            const auto light =
                static_cast<ListedLight>(job.light_at(static_cast<LightIndex>(candidate) - 1));
            ask(row, std::span(&light, 1));
        }
    }
}

/// Of many, the lists of the tile are asked where there are any: list_of(row, lists).
template <class T, class IsAsked, class ListOf, class DistanceOf, class Ask>
void ask_listed(const TileJob<T>& job, const Batch<T>& batch, const IsAsked& is_asked,
                const ListOf& list_of, const DistanceOf& distance_of, const Ask& ask, RowList& left)
{
    ListedRays<T> listed(job, batch);
    for (int row = 0; row < batch.rows; ++row)
        if (is_asked(row) &&
            !listed.note(row, [&](const Blockers& lists) { return list_of(row, lists); }))
            left.note(row, true);
    listed.for_each_met(distance_of, ask);
}

}  // namespace

template <class T> void meet_lights(const TileJob<T>& job, Batch<T>& batch)
{
    RowList left;  // to the hierarchy
    const auto is_asked = [&](int row) { return !is_zero(batch.wi, row); };
    const auto ray_of = [&](int row) {
        return LightHierarchy::Ray{shading_point(job, batch, row).x, unit_direction(batch, row)};
    };
    const auto put = [&](int row, const LightHit& hit) {
        batch.light[static_cast<std::size_t>(row)] = hit.light;
        batch.distance[static_cast<std::size_t>(row)] = static_cast<T>(hit.distance);
    };
    const auto ask = [&](int row, std::span<const ListedLight> lights) {
        const LightHierarchy::Ray ray = ray_of(row);
        put(row, job.hierarchy->nearest(ray.x, ray.wi, lights));
    };
    std::fill_n(batch.light.begin(), batch.rows, no_light);
    if (job.lights->size() <= most_screened_lights) {
        ask_screened(job, batch, is_asked, ask, left);
    } else {
        const auto list_along = [&](int row, const Blockers& lists) {
            return lists.often_along(vec_cast<float>(batch.wi.at(row)));
        };
        ask_listed(
            job, batch, is_asked, list_along,
            [](int) { return std::numeric_limits<T>::infinity(); }, ask, left);
    }
    job.hierarchy->nearest_each(
        left.count, [&](std::size_t i) { return ray_of(left[i]); },
        [&](std::size_t i, const LightHit& hit) { put(left[i], hit); });
    keep_rows(batch, [&](int row) { return batch.light[static_cast<std::size_t>(row)] >= 0; });
}

template <class T> void fetch_radiance(const TileJob<T>& job, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row) {
        const auto j = static_cast<std::size_t>(batch.light[static_cast<std::size_t>(row)]);
        batch.radiance.put(row, vec_cast<T>(radiance((*job.lights)[j]) * job.radiance_scale));
    }
}

template <class T> void hide_by_lights(const TileJob<T>& job, Batch<T>& batch)
{
    RowList left;  // to the hierarchy
    const auto is_asked = [&](int row) {
        return !is_zero(batch.contribution, row) &&
               !job.knows(batch.light[static_cast<std::size_t>(row)], unhidden);
    };
    const auto ray_of = [&](int row) {
        return LightHierarchy::Ray{shading_point(job, batch, row).x,
                                   exact_direction(job, batch, row)};
    };
    const auto hide = [&](int row, bool is_hidden) {
        if (is_hidden) batch.contribution.put(row, Vec3<T>(T(0)));
    };
    const auto ask = [&](int row, std::span<const ListedLight> lights) {
        const LightHierarchy::Ray ray = ray_of(row);
        hide(row, job.hierarchy->hides(ray.x, ray.wi, own_hit(job, batch, row, ray.wi), lights));
    };
    if (job.lights->size() <= most_screened_lights) {
        ask_screened(job, batch, is_asked, ask, left);
    } else {
        const auto list_before = [&](int row, const Blockers& lists) {
            return lists.often_before(batch.light[static_cast<std::size_t>(row)]);
        };
        // Near the rim of a light, its distance is known to a thousandth of its radius.
        const auto distance_of = [&](int row) {
            const auto i = static_cast<std::size_t>(row);
            return batch.distance[i] + T(1e-3) * batch.radius[i];
        };
        ask_listed(job, batch, is_asked, list_before, distance_of, ask, left);
    }
    job.hierarchy->hides_each(
        left.count, [&](std::size_t i) { return ray_of(left[i]); },
        [&](std::size_t i, const LightHierarchy::Ray& ray) {
            return own_hit(job, batch, left[i], ray.wi);
        },
        [&](std::size_t i, bool is_hidden) { hide(left[i], is_hidden); });
}

template <class T> void hide_by_surfaces(const TileJob<T>& job, Batch<T>& batch)
{
    std::array<ShadowRay, batch_capacity> rays;       // NOLINT: filled as far as it is read
    std::array<std::int32_t, batch_capacity> row_of;  // NOLINT
    std::array<std::uint8_t, batch_capacity> hidden;  // NOLINT
    std::size_t count = 0;
    for (int row = 0; row < batch.rows; ++row) {
        if (is_zero(batch.contribution, row)) continue;
        if (job.knows(batch.light[static_cast<std::size_t>(row)], unshadowed)) continue;
        row_of[count] = row;
        rays[count++] =
            shadow_ray(shading_point(job, batch, row), vec_cast<float>(batch.wi.at(row)),
                       static_cast<double>(batch.distance[static_cast<std::size_t>(row)]));
    }
    job.surfaces->occluded(std::span(rays).first(count), std::span(hidden).first(count));
    batch.shadow_rays += count;
    for (std::size_t i = 0; i < count; ++i)
        if (hidden[i] != 0) batch.contribution.put(row_of[i], Vec3<T>(T(0)));
}

#define MIS_INSTANTIATE(T)                                       \
    template void start_rows(const TileJob<T>&, Batch<T>&);      \
    template void keep_light_rows(const TileJob<T>&, Batch<T>&); \
    template void keep_bsdf_rows(const TileJob<T>&, Batch<T>&);  \
    template void meet_lights(const TileJob<T>&, Batch<T>&);     \
    template void fetch_radiance(const TileJob<T>&, Batch<T>&);  \
    template void hide_by_lights(const TileJob<T>&, Batch<T>&);  \
    template void hide_by_surfaces(const TileJob<T>&, Batch<T>&);
MIS_INSTANTIATE(float)
MIS_INSTANTIATE(double)
#undef MIS_INSTANTIATE

}  // namespace mis
