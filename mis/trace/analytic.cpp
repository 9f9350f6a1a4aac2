#include "mis/trace/analytic.h"

#include "mis/trace/intersect.h"
#include "mis/trace/surface_points.h"

namespace mis {

namespace {

/// visit(distance, location) for every surface that the ray meets, until it returns false.
template <class Visit>
void for_each_hit(const Scene& scene, const Vec3<double>& origin, const Vec3<double>& direction,
                  const Visit& visit)
{
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
        const auto& shape = scene.surfaces[s].shape;
        if (const auto* sphere = std::get_if<SphereSurface>(&shape)) {
            if (!visit(hit_sphere(origin, direction, sphere->center, sphere->radius),
                       SurfaceLocation{s, 0}))
                return;
        } else if (const auto* quad = std::get_if<Quad>(&shape)) {
            if (!visit(hit_quad(origin, direction, *quad).distance, SurfaceLocation{s, 0})) return;
        } else {
            const Mesh& mesh = std::get<Mesh>(shape);
            for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
                const auto& i = mesh.triangles[t];
                const PlaneHit hit = hit_triangle(origin, direction, mesh.positions[i[0]],
                                                  mesh.positions[i[1]], mesh.positions[i[2]]);
                if (!visit(hit.distance, SurfaceLocation{s, t})) return;
            }
        }
    }
}

}  // namespace

AnalyticTracer::AnalyticTracer(const Scene& scene) : scene_(&scene) {}

void AnalyticTracer::occluded(std::span<const ShadowRay> rays, std::span<std::uint8_t> hidden) const
{
    for (std::size_t i = 0; i < rays.size(); ++i) {
        hidden[i] = 0;
        const double limit = static_cast<double>(rays[i].distance);
        const Vec3<double> start = vec_cast<double>(rays[i].origin) + origin();
        for_each_hit(*scene_, start, vec_cast<double>(rays[i].direction),
                     [&](double distance, const SurfaceLocation&) {
                         hidden[i] = distance < limit ? 1 : 0;
                         return hidden[i] == 0;
                     });
    }
}

std::optional<SurfaceHit> AnalyticTracer::first_hit(const Vec3<double>& start,
                                                    const Vec3<double>& direction) const
{
    double nearest = no_hit;
    SurfaceLocation location;
    for_each_hit(*scene_, start, direction, [&](double distance, const SurfaceLocation& at) {
        if (distance < nearest) nearest = distance, location = at;
        return true;
    });
    return nearest < no_hit ? hit_at(*scene_, location, start, direction, origin()) : std::nullopt;
}

Vec3<double> AnalyticTracer::origin() const { return frame_origin_of(*scene_); }

double AnalyticTracer::offset_at(const Vec3<double>& x) const
{
    return offset_of_point(*scene_, x, origin());
}

void AnalyticTracer::offsets_at(std::span<const Vec3<double>> points, std::span<double> offsets,
                                const ForEach& for_each) const
{
    offsets_of_points(*scene_, points, origin(), for_each, offsets);
}

}  // namespace mis
