#include "mis/engine/gbuffer.h"

#include "mis/scene/direction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace mis {

namespace {

/// The directions through the pixels' centres.
class PixelRays {
public:
    explicit PixelRays(const Camera& camera) : camera_(camera)
    {
        forward_ = unit_or_zero(camera.target - camera.position);
        right_ = unit_or_zero(cross(forward_, camera.up));
        up_ = cross(right_, forward_);
        half_height_ = std::tan(camera.vertical_fov_degrees * std::numbers::pi / 360);
    }
    Vec3<double> direction(int column, int row) const
    {
        const double width = camera_.resolution[0], height = camera_.resolution[1];
        const double across = (2 * (column + 0.5) - width) / height * half_height_;
        const double above = (height - 2 * (row + 0.5)) / height * half_height_;
        return normalized(forward_ + right_ * across + up_ * above);
    }

private:
    Camera camera_;
    Vec3<double> forward_, right_, up_;
    double half_height_;
};

/// Some points, those that are dark, and those that are none.
struct Found {
    std::map<int, std::vector<ShadingPoint>> by_material;
    std::vector<std::uint32_t> dark;
    std::vector<Background> background;
    PointCounts counts;
};

/// Are all lights below the point's tangent plane, by more than the rounding of its normal?
bool faces_no_light(const ShadingPoint& point, const Lights& lights)
{
    constexpr std::size_t most = 1024;  // to look at
    if (lights.size() > most) return false;
    const Vec3<double> n = vec_cast<double>(point.n);
    return std::all_of(lights.begin(), lights.end(), [&](const Light& light) {
        const Vec3<double> to_center = light.center - point.x;
        return dot(n, to_center) < -light.radius - 1e-6 * (length(to_center) + light.radius);
    });
}

/// Files a point under its material, or as dark: on the inside of a light, seen from below its
/// surface, or facing no light.
void add_point(Found& found, const ShadingPoint& point, int material, const Lights& all,
               const LightHierarchy& lights)
{
    std::size_t* reason = nullptr;
    if (!(dot(point.n, point.wo) > 0)) reason = &found.counts.seen_from_below;
    else if (lights.contains(point.x)) reason = &found.counts.inside_light;
    else if (faces_no_light(point, all)) reason = &found.counts.facing_no_light;
    if (reason != nullptr) ++*reason, found.dark.push_back(point.id);
    else found.by_material[material].push_back(point);
}

void add_pixel(Found& found, const Scene& scene, const PixelRays& rays,
               const LightHierarchy& lights, const SurfaceTracer* surfaces, int column, int row)
{
    const auto id =
        static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(scene.camera->resolution[0]) +
        static_cast<std::uint32_t>(column);
    const Vec3<double> origin = scene.camera->position, direction = rays.direction(column, row);
    const LightHit light = lights.nearest(origin, direction);
    const std::optional<SurfaceHit> hit =
        surfaces != nullptr ? surfaces->first_hit(origin, direction) : std::nullopt;
    if (!hit || light.distance < hit->distance) {
        found.background.push_back({id, light.light});
        return;
    }
    const std::size_t dark = found.dark.size();
    const Vec3<double> off = hit->x + hit->geometric * hit->offset;
    add_point(found,
              {hit->x, vec_cast<float>(hit->n), vec_cast<float>(-direction),
               vec_cast<float>(off - surfaces->origin()), id},
              hit->material, scene.lights, lights);
    if (!hit->is_n_behind()) return;
    ++found.counts.turned_normals;
    found.counts.turned_and_dark += found.dark.size() - dark;
}

void append(GBuffer& buffer, const Found& found)
{
    for (const auto& [material, points] : found.by_material) {
        buffer.tiles.push_back({static_cast<std::uint32_t>(buffer.points.size()),
                                static_cast<std::uint32_t>(points.size()), material,
                                points.front().x});
        buffer.points.insert(buffer.points.end(), points.begin(), points.end());
    }
    buffer.dark.insert(buffer.dark.end(), found.dark.begin(), found.dark.end());
    buffer.background.insert(buffer.background.end(), found.background.begin(),
                             found.background.end());
    buffer.counts.add(found.counts);
}

/// How far rays start off each probe; none without surfaces.
std::vector<double> offsets_of_probes(const Scene& scene, const SurfaceTracer* surfaces,
                                      const AnyExecutor& executor)
{
    if (surfaces == nullptr) return {};
    std::vector<Vec3<double>> positions;
    for (const Probe& probe : scene.probes) positions.push_back(probe.position);
    std::vector<double> offsets(positions.size());
    surfaces->offsets_at(positions, offsets, executor.for_each);
    return offsets;
}

}  // namespace

GBuffer find_shading_points(const Scene& scene, const LightHierarchy& lights,
                            const SurfaceTracer* surfaces, int first_row, int rows,
                            const AnyExecutor& executor)
{
    GBuffer buffer{.width = scene.camera->resolution[0], .height = scene.camera->resolution[1]};
    buffer.first_row = first_row;
    buffer.rows = rows;
    const PixelRays rays(*scene.camera);
    const int across = (buffer.width + tile_side - 1) / tile_side,
              down = (rows + tile_side - 1) / tile_side;
    std::vector<Found> blocks(static_cast<std::size_t>(across) * static_cast<std::size_t>(down));
    executor.for_each(blocks.size(), [&](std::size_t b) {
        const int left = static_cast<int>(b % static_cast<std::size_t>(across)) * tile_side;
        const int top =
            first_row + static_cast<int>(b / static_cast<std::size_t>(across)) * tile_side;
        for (int row = top; row < std::min(top + tile_side, first_row + rows); ++row)
            for (int column = left; column < std::min(left + tile_side, buffer.width); ++column)
                add_pixel(blocks[b], scene, rays, lights, surfaces, column, row);
    });
    for (const Found& found : blocks) append(buffer, found);
    return buffer;
}

GBuffer probe_points(const Scene& scene, const LightHierarchy& lights,
                     const SurfaceTracer* surfaces, const AnyExecutor& executor)
{
    const std::uint32_t pixels = scene.camera
                                     ? static_cast<std::uint32_t>(scene.camera->resolution[0]) *
                                           static_cast<std::uint32_t>(scene.camera->resolution[1])
                                     : 0;
    const std::vector<double> offsets = offsets_of_probes(scene, surfaces, executor);
    const auto ray_origin = [&](std::size_t p) {
        if (surfaces == nullptr) return Vec3<double>(0);
        const Probe& probe = scene.probes[p];
        return probe.position + probe.normal * offsets[p] - surfaces->origin();
    };
    constexpr std::size_t at_once = 64;
    std::vector<Found> found(scene.probes.size());
    executor.for_each((found.size() + at_once - 1) / at_once, [&](std::size_t block) {
        const std::size_t end = std::min((block + 1) * at_once, found.size());
        for (std::size_t p = block * at_once; p < end; ++p) {
            const Probe& probe = scene.probes[p];
            add_point(
                found[p],
                {probe.position, vec_cast<float>(probe.normal), vec_cast<float>(probe.outgoing),
                 vec_cast<float>(ray_origin(p)), pixels + static_cast<std::uint32_t>(p)},
                probe.material, scene.lights, lights);
        }
    });
    GBuffer buffer;
    for (const Found& of_probe : found) append(buffer, of_probe);
    return buffer;
}

void plan_tiles(GBuffer& buffer, const TilePlanner& planner, const AnyExecutor& executor)
{
    executor.for_each(buffer.tiles.size(), [&](std::size_t t) {
        Tile& tile = buffer.tiles[t];
        tile.plan = planner.plan(std::span(buffer.points).subspan(tile.first, tile.count));
    });
}

}  // namespace mis
