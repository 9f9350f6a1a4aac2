#include "mis/engine/stages_trace.h"

#include "mis/engine/listed_rays.h"
#include "mis/engine/rows.h"
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
        batch.u[i] = batch.v[i] = batch.lobe[i] = T(0.5);
    }
}

namespace {

/// Moves the kept rows to the front, with all that the later stages of either half read.
template <class T, class Keep> void keep_rows(Batch<T>& batch, const Keep& keep)
{
    batch.rows_are_samples = false;
    int kept = 0;
    for (int row = 0; row < batch.rows; ++row) {
        if (!keep(row)) continue;
        if (kept != row) {
            const auto from = static_cast<std::size_t>(row), to = static_cast<std::size_t>(kept);
            batch.slot[to] = batch.slot[from];
            batch.point[to] = batch.point[from];
            batch.light[to] = batch.light[from];
            batch.distance[to] = batch.distance[from];
            batch.x.put(kept, batch.x.at(row));
            batch.n.put(kept, batch.n.at(row));
            batch.wo.put(kept, batch.wo.at(row));
            batch.wi.put(kept, batch.wi.at(row));
        }
        ++kept;
    }
    batch.rows = kept;
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

template <class T> void meet_lights(const TileJob<T>& job, Batch<T>& batch)
{
    const bool is_screened = job.lights->size() <= most_screened_lights;
    std::array<std::int32_t, batch_capacity> row_of;  // NOLINT: filled as far as it is read
    std::size_t count = 0;
    ListedRays<T> listed(job, batch);
    for (int row = 0; row < batch.rows; ++row) {
        const auto i = static_cast<std::size_t>(row);
        batch.light[i] = no_light;
        if (is_zero(batch.wi, row) || (is_screened && batch.candidate[i] == 0)) continue;
        const auto list_along = [wi = vec_cast<float>(batch.wi.at(row))](const Blockers& lists) {
            return lists.often_along(wi);
        };
        if (is_screened || !listed.note(row, list_along)) row_of[count++] = row;
    }
    listed.for_each_met(
        [](int) { return std::numeric_limits<T>::infinity(); },
        [&](int row, std::span<const ListedLight> lights) {
            const LightHit hit = job.hierarchy->nearest(shading_point(job, batch, row).x,
                                                        unit_direction(batch, row), lights);
            batch.light[static_cast<std::size_t>(row)] = hit.light;
            batch.distance[static_cast<std::size_t>(row)] = static_cast<T>(hit.distance);
        });
    job.hierarchy->nearest_each(
        count,
        [&](std::size_t i) {
            return LightHierarchy::Ray{shading_point(job, batch, row_of[i]).x,
                                       unit_direction(batch, row_of[i])};
        },
        [&](std::size_t i, const LightHit& hit) {
            const auto row = static_cast<std::size_t>(row_of[i]);
            batch.light[row] = hit.light;
            batch.distance[row] = static_cast<T>(hit.distance);
        });
    keep_rows(batch, [&](int row) { return batch.light[static_cast<std::size_t>(row)] >= 0; });
}

template <class T> void fetch_radiance(const TileJob<T>& job, Batch<T>& batch)
{
    for (int row = 0; row < batch.rows; ++row) {
        const auto j = static_cast<std::size_t>(batch.light[static_cast<std::size_t>(row)]);
        batch.radiance.put(row, vec_cast<T>(radiance((*job.lights)[j])));
    }
}

template <class T> void hide_by_lights(const TileJob<T>& job, Batch<T>& batch)
{
    const bool is_screened = job.lights->size() <= most_screened_lights;
    std::array<std::int32_t, batch_capacity> row_of;  // NOLINT: filled as far as it is read
    std::size_t count = 0;
    ListedRays<T> listed(job, batch);
    const auto ray_of = [&](int row) {
        return LightHierarchy::Ray{shading_point(job, batch, row).x,
                                   exact_direction(job, batch, row)};
    };
    for (int row = 0; row < batch.rows; ++row) {
        if (is_zero(batch.contribution, row)) continue;
        if (is_screened && batch.candidate[static_cast<std::size_t>(row)] == 0) continue;
        const LightIndex j = batch.light[static_cast<std::size_t>(row)];
        if (job.knows(j, unhidden)) continue;
        if (!listed.note(row, [j](const Blockers& lists) { return lists.often_before(j); }))
            row_of[count++] = row;
    }
    listed.for_each_met(
        // Near the rim of a light, its distance is known to a thousandth of its radius.
        [&](int row) {
            const auto i = static_cast<std::size_t>(row);
            return batch.distance[i] + T(1e-3) * batch.radius[i];
        },
        [&](int row, std::span<const ListedLight> lights) {
            const LightHierarchy::Ray ray = ray_of(row);
            if (job.hierarchy->hides(ray.x, ray.wi, own_hit(job, batch, row, ray.wi), lights))
                batch.contribution.put(row, Vec3<T>(T(0)));
        });
    job.hierarchy->hides_each(
        count, [&](std::size_t i) { return ray_of(row_of[i]); },
        [&](std::size_t i, const LightHierarchy::Ray& ray) {
            return own_hit(job, batch, row_of[i], ray.wi);
        },
        [&](std::size_t i, bool is_hidden) {
            if (is_hidden) batch.contribution.put(row_of[i], Vec3<T>(T(0)));
        });
}

namespace {

/// To a light, and no further than to what may touch it: rays start some way off their point and
/// are traced in float, so what is met that little before the light is not nearer than it.
ShadowRay shadow_ray(const ShadingPoint& point, const Vec3<float>& wi, double distance)
{
    const double off = float_offset(largest_coordinate(vec_cast<double>(point.ray_origin)));
    return {point.ray_origin, wi, static_cast<float>(std::max(distance * (1 - 1e-6) - off, 0.0))};
}

}  // namespace

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
