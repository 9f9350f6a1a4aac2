#include "mis/trace/surface_points.h"

#include "mis/math/limits.h"
#include "mis/trace/intersect.h"
#include "mis/trace/point_tree.h"

#include <algorithm>
#include <utility>
#include <vector>

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
    const Vec3<double> normal = cross(plane.e1, plane.e2);
    if (!(length(normal) > 0)) return false;
    const Vec3<double> unit = normalized(normal);
    const double tolerance = float_offset(plane.largest);
    if (!(std::abs(dot(x - plane.corner, unit)) <= tolerance)) return false;
    const PlaneHit at = hit_plane(x, -unit, plane.corner, plane.e1, plane.e2);
    const double slack = tolerance / std::min(length(plane.e1), length(plane.e2));
    return at.u >= -slack && at.v >= -slack &&
           (is_triangle ? at.u + at.v : std::max(at.u, at.v)) <= 1 + slack;
}

/// Two corners of a box.
struct PlaneBox {
    Vec3<double> low, high;
};

/// Around all points that lie on the plane's triangle or parallelogram, as lies_on says, with room
/// for its rounding; all of space, where that is not known.
PlaneBox box_of(const Plane& plane, bool is_triangle)
{
    const double a = length(plane.e1), b = length(plane.e2),
                 area = length(cross(plane.e1, plane.e2));
    if (!(area > 0)) return {Vec3<double>(infinity), Vec3<double>(-infinity)};  // nothing does
    const double tolerance = float_offset(plane.largest), slack = tolerance / std::min(a, b);
    // Of u and v: the thinner the triangle, the more digits are lost.
    const double rounding = 1e-14 * std::max(a, b) * std::max(a, b) / area;
    if (!(rounding < 0.1)) return {Vec3<double>(-infinity), Vec3<double>(infinity)};
    const double reach = 2 * tolerance + 2 * (slack + 4 * rounding * (1 + slack)) * (a + b);
    PlaneBox box{plane.corner, plane.corner};
    const auto add = [&](const Vec3<double>& p) {
        box.low = glm::min(box.low, p), box.high = glm::max(box.high, p);
    };
    add(plane.corner + plane.e1), add(plane.corner + plane.e2);
    if (!is_triangle) add(plane.corner + plane.e1 + plane.e2);
    return {box.low - reach, box.high + reach};
}

/// The largest offset among the surfaces that each of some points lies on, in parts of the scene.
class OffsetSearch {
public:
    OffsetSearch(const Scene& scene, std::span<const Vec3<double>> points,
                 const Vec3<double>& frame_origin, std::span<const double> least)
        : scene_(scene), points_(points), frame_origin_(frame_origin), offsets_(least),
          tree_(points)
    {
        for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
            const auto* mesh = std::get_if<Mesh>(&scene.surfaces[s].shape);
            const std::size_t count = mesh != nullptr ? mesh->triangles.size() : 1;
            for (std::size_t first = 0; first < count; first += part_size)
                parts_.push_back({s, first, std::min(first + part_size, count)});
        }
    }

    std::size_t parts() const { return parts_.size(); }

    /// A point, and the offset that a surface of a part asks for, which is larger than the least.
    using Found = std::vector<std::pair<std::uint32_t, double>>;
    Found in_part(std::size_t number) const
    {
        Found found;
        const auto [s, first, end] = parts_[number];
        const Surface& surface = scene_.surfaces[s];
        if (const auto* quad = std::get_if<Quad>(&surface.shape))
            consider(plane_of(*quad, frame_origin_), false, found);
        if (const auto* mesh = std::get_if<Mesh>(&surface.shape))
            for (std::size_t t = first; t < end; ++t)
                consider(plane_of(corners(*mesh, static_cast<std::uint32_t>(t)), frame_origin_),
                         true, found);
        return found;
    }

private:
    static constexpr std::size_t part_size = 1 << 14;
    struct Part {
        std::size_t surface, first, end;  ///< of its triangles
    };

    void consider(const Plane& plane, bool is_triangle, Found& found) const
    {
        const PlaneBox box = box_of(plane, is_triangle);
        const double own = float_offset(plane.largest);
        tree_.for_each_near(box.low, box.high, [&](std::uint32_t i) {
            if (own > offsets_[i] && lies_on(points_[i], plane, is_triangle))
                found.emplace_back(i, own);
        });
    }

    const Scene& scene_;
    std::span<const Vec3<double>> points_;
    Vec3<double> frame_origin_;
    std::span<const double> offsets_;
    PointTree tree_;
    std::vector<Part> parts_;
};

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

void offsets_of_points(const Scene& scene, std::span<const Vec3<double>> points,
                       const Vec3<double>& frame_origin, const ForEach& for_each,
                       std::span<double> offsets)
{
    std::vector<double> least;
    for (const Vec3<double>& x : points)
        least.push_back(float_offset(largest_coordinate(x - frame_origin)));
    const OffsetSearch search(scene, points, frame_origin, least);
    std::vector<OffsetSearch::Found> found(search.parts());
    for_each(found.size(), [&](std::size_t part) { found[part] = search.in_part(part); });
    std::copy(least.begin(), least.end(), offsets.begin());
    for (const OffsetSearch::Found& part : found)
        for (const auto& [i, own] : part) offsets[i] = std::max(offsets[i], own);
}

Vec3<double> frame_origin_of(const Scene& scene)
{
    if (scene.camera) return scene.camera->target;
    return scene.probes.empty() ? Vec3<double>(0) : scene.probes.front().position;
}

}  // namespace mis
