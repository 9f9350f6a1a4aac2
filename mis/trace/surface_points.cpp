#include "mis/trace/surface_points.h"

#include "mis/trace/intersect.h"

namespace mis {

namespace {

/// A corner, two edges, and what floats must hold to place them.
struct Plane {
    Vec3<double> corner, e1, e2;
    double largest;  ///< coordinate of its corners in the tracer's frame
};

Plane plane_of(const std::array<Vec3<double>, 3>& p, const Vec3<double>& frame_origin)
{
    double largest = 0;
    for (const Vec3<double>& corner : p)
        largest = std::max(largest, largest_coordinate(corner - frame_origin));
    return {p[0], p[1] - p[0], p[2] - p[0], largest};
}

Plane plane_of(const Quad& quad, const Vec3<double>& frame_origin)
{
    const Vec3<double> a = quad.corner, b = a + quad.edges[0], c = a + quad.edges[1];
    const double opposite = largest_coordinate(b + quad.edges[1] - frame_origin);
    const Plane plane = plane_of(std::array{a, b, c}, frame_origin);
    return {a, quad.edges[0], quad.edges[1], std::max(plane.largest, opposite)};
}

std::array<Vec3<double>, 3> corners(const Mesh& mesh, std::uint32_t triangle)
{
    const auto& t = mesh.triangles[triangle];
    return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

SurfaceHit facing(const Vec3<double>& x, Vec3<double> geometric, Vec3<double> n, double distance,
                  double offset, const Vec3<double>& direction, int material)
{
    if (dot(geometric, direction) > 0) geometric = -geometric;
    if (dot(n, direction) > 0) n = -n;
    return {x, geometric, n, distance, offset, material};
}

Vec3<double> smooth_normal(const Mesh& mesh, std::uint32_t triangle, const PlaneHit& hit,
                           const Vec3<double>& flat)
{
    if (mesh.normals.empty()) return flat;
    const auto& t = mesh.triangles[triangle];
    const Vec3<double> n = vec_cast<double>(mesh.normals[t[0]]) * (1 - hit.u - hit.v) +
                           vec_cast<double>(mesh.normals[t[1]]) * hit.u +
                           vec_cast<double>(mesh.normals[t[2]]) * hit.v;
    return length2(n) > 0 ? normalized(n) : flat;
}

bool lies_on(const Vec3<double>& x, const Plane& plane, bool is_triangle)
{
    const Vec3<double> normal = cross(plane.e1, plane.e2), unit = normalized(normal);
    const double tolerance = float_offset(plane.largest);
    if (!(std::abs(dot(x - plane.corner, unit)) <= tolerance)) return false;
    const PlaneHit at = hit_plane(x, -unit, plane.corner, plane.e1, plane.e2);
    const double slack = tolerance / std::min(length(plane.e1), length(plane.e2));
    return at.u >= -slack && at.v >= -slack &&
           (is_triangle ? at.u + at.v : std::max(at.u, at.v)) <= 1 + slack;
}

}  // namespace

std::optional<SurfaceHit> hit_at(const Scene& scene, const SurfaceLocation& location,
                                 const Vec3<double>& origin, const Vec3<double>& direction,
                                 const Vec3<double>& frame_origin)
{
    const Surface& surface = scene.surfaces[location.surface];
    if (const auto* sphere = std::get_if<SphereSurface>(&surface.shape)) {
        const double distance = hit_sphere(origin, direction, sphere->center, sphere->radius);
        if (distance == no_hit) return std::nullopt;
        const Vec3<double> n = normalized(origin + direction * distance - sphere->center);
        const Vec3<double> x = sphere->center + n * sphere->radius;
        const double offset = float_offset(largest_coordinate(x - frame_origin));
        return facing(x, n, n, distance, offset, direction, surface.material);
    }
    const auto* mesh = std::get_if<Mesh>(&surface.shape);
    const Plane plane = mesh != nullptr ? plane_of(corners(*mesh, location.triangle), frame_origin)
                                        : plane_of(std::get<Quad>(surface.shape), frame_origin);
    const PlaneHit hit = hit_plane(origin, direction, plane.corner, plane.e1, plane.e2);
    if (!(hit.distance > 0 && hit.distance < no_hit)) return std::nullopt;
    const Vec3<double> flat = normalized(cross(plane.e1, plane.e2));
    const Vec3<double> n =
        mesh != nullptr ? smooth_normal(*mesh, location.triangle, hit, flat) : flat;
    const Vec3<double> x = plane.corner + plane.e1 * hit.u + plane.e2 * hit.v;
    return facing(x, flat, n, hit.distance, float_offset(plane.largest), direction,
                  surface.material);
}

double offset_of_point(const Scene& scene, const Vec3<double>& x, const Vec3<double>& frame_origin)
{
    double offset = float_offset(largest_coordinate(x - frame_origin));
    const auto consider = [&](const Plane& plane, bool is_triangle) {
        const double own = float_offset(plane.largest);
        if (own > offset && lies_on(x, plane, is_triangle)) offset = own;
    };
    for (const Surface& surface : scene.surfaces) {
        if (const auto* quad = std::get_if<Quad>(&surface.shape))
            consider(plane_of(*quad, frame_origin), false);
        if (const auto* mesh = std::get_if<Mesh>(&surface.shape))
            for (std::uint32_t t = 0; t < mesh->triangles.size(); ++t)
                consider(plane_of(corners(*mesh, t), frame_origin), true);
    }
    return offset;
}

Vec3<double> frame_origin_of(const Scene& scene)
{
    if (scene.camera) return scene.camera->target;
    return scene.probes.empty() ? Vec3<double>(0) : scene.probes.front().position;
}

}  // namespace mis
