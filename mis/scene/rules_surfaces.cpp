#include "mis/scene/rules.h"

#include "mis/scene/text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <variant>

namespace mis {

namespace {

MaybeProblem check_shape(const SphereSurface& sphere, const StopToken&)
{
    return first_problem([&] { return check_position("/center", sphere.center); },
                         [&] { return check_radius("/radius", sphere.radius); });
}

MaybeProblem check_shape(const Quad& quad, const StopToken&)
{
    const auto edges = [&]() -> MaybeProblem {
        if (sine_between(quad.edges[0], quad.edges[1]) >= limits::min_sine) return {};
        return Problem{"/edges", "[" + to_text(quad.edges[0]) + ", " + to_text(quad.edges[1]) + "]",
                       "a quad's two edges have a length and are not parallel",
                       "Give two edges that span an area."};
    };
    return first_problem([&] { return check_position("/corner", quad.corner); },
                         [&] { return check_position("/edges/0", quad.edges[0]); },
                         [&] { return check_position("/edges/1", quad.edges[1]); }, edges);
}

MaybeProblem check_triangles(const Mesh& mesh, const StopToken& stop)
{
    if (mesh.triangles.empty())
        return Problem{"/file", "a mesh without triangles", "a mesh has at least one triangle",
                       "Remove the surface."};
    return first_problem_among(
        mesh.triangles, stop, [&](const auto& triangle, std::size_t i) -> MaybeProblem {
            const std::uint32_t last = std::max({triangle[0], triangle[1], triangle[2]});
            if (last < mesh.positions.size()) return {};
            return Problem{
                "/file", "vertex " + to_text(std::size_t{last}) + " in triangle " + to_text(i),
                "the mesh has " + many(mesh.positions.size(), "vertex") + ", counted from 0",
                "Mend the mesh."};
        });
}

MaybeProblem check_vertices(const Mesh& mesh, const StopToken& stop)
{
    return first_problem_among(
        mesh.positions, stop, [](const Vec3<double>& position, std::size_t i) -> MaybeProblem {
            if (is_position(position)) return {};
            return Problem{"/file", "vertex " + to_text(i) + " at " + to_text(position),
                           coordinates_allowed(), "Look at the mesh, and at its transform."};
        });
}

MaybeProblem check_normals(const Mesh& mesh, const StopToken& stop)
{
    constexpr float tolerance = 1e-4f;
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size())
        return Problem{
            "/file",
            many(mesh.normals.size(), "normal") + " for " + many(mesh.positions.size(), "vertex"),
            "a mesh has one normal per vertex, or none at all", "Mend the mesh."};
    return first_problem_among(
        mesh.normals, stop, [](const Vec3<float>& normal, std::size_t i) -> MaybeProblem {
            if (std::abs(length(normal) - 1) <= tolerance) return {};
            return Problem{
                "/file", "normal " + to_text(vec_cast<double>(normal)) + " at vertex " + to_text(i),
                "a normal is a unit vector here", "Normalise it."};
        });
}

MaybeProblem check_shape(const Mesh& mesh, const StopToken& stop)
{
    return first_problem([&] { return check_triangles(mesh, stop); },
                         [&] { return check_vertices(mesh, stop); },
                         [&] { return check_normals(mesh, stop); });
}

}  // namespace

MaybeProblem check_surface(const Surface& surface, const Scene& scene, const StopToken& stop)
{
    return first_problem(
        [&] {
            return std::visit([&](const auto& shape) { return check_shape(shape, stop); },
                              surface.shape);
        },
        [&] { return check_material_index("/material", surface.material, scene); });
}

MaybeProblem check_triangle_count(const Scene& scene)
{
    std::size_t count = 0;
    for (const Surface& surface : scene.surfaces)
        if (const Mesh* mesh = std::get_if<Mesh>(&surface.shape)) count += mesh->triangles.size();
    if (count <= limits::triangles) return {};
    return Problem{"/surfaces", many(count, "triangle"),
                   "a scene has at most " + to_text(limits::triangles) + " triangles",
                   "Simplify the meshes, or split the scene."};
}

}  // namespace mis
