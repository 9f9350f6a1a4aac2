#include "mis/scene/validate.h"

#include "mis/scene/direction.h"
#include "mis/scene/material_fields.h"
#include "mis/scene/nearest_name.h"
#include "mis/scene/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace mis {
namespace {

using MaybeProblem = std::optional<Problem>;

/// The first problem that the rules find, asked in their order.
template <class... Rules> MaybeProblem first_problem(const Rules&... rules)
{
    MaybeProblem problem;
    (void)((problem = rules(), problem.has_value()) || ...);
    return problem;
}

/// The first problem among `items`, each examined with its index.
template <class Items, class Rule>
MaybeProblem first_problem_among(const Items& items, const StopToken& stop, const Rule& rule)
{
    StopEvery check(stop, 1 << 14);
    for (std::size_t i = 0; i < items.size(); ++i) {
        check();
        if (MaybeProblem problem = rule(items[i], i)) return problem;
    }
    return {};
}

MaybeProblem placed_below(const std::string& pointer, MaybeProblem problem)
{
    if (problem) problem->pointer.insert(0, pointer);
    return problem;
}

bool is_position(const Vec3<double>& p)
{
    const auto in_range = [](double x) { return std::abs(x) <= limits::length; };  // false for NaN
    return in_range(p.x) && in_range(p.y) && in_range(p.z);
}

bool is_finite(const Vec3<double>& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string coordinates_allowed()
{
    return "a coordinate lies within ±" + to_text(limits::length) + " scene units";
}

MaybeProblem check_position(const std::string& pointer, const Vec3<double>& position)
{
    if (is_position(position)) return {};
    return Problem{pointer, to_text(position), coordinates_allowed(),
                   "Use larger units, or move the scene closer to its origin."};
}

MaybeProblem check_radius(const std::string& pointer, double radius)
{
    if (!(radius > 0))
        return Problem{pointer, to_text(radius), "a radius is greater than 0",
                       "Make it positive, or remove the sphere."};
    if (radius >= limits::min_radius && radius <= limits::length) return {};
    return Problem{
        pointer, to_text(radius),
        "a radius lies between " + to_text(limits::min_radius) + " and " + to_text(limits::length),
        "Use other units of length."};
}

/// Sine of the angle between two vectors of any finite length; 0 where one of them is 0.
double sine_between(const Vec3<double>& a, const Vec3<double>& b)
{
    return length(cross(unit_or_zero(a), unit_or_zero(b)));
}

// ── camera and probes ──

MaybeProblem check_view(const Camera& camera)
{
    const std::string view = "/camera/target", up = "/camera/up";
    if (!is_finite(camera.up) || camera.up == Vec3<double>(0))
        return Problem{up, to_text(camera.up), "up is a direction: finite numbers, not all 0",
                       "Write [0, 1, 0] for a level camera."};
    if (camera.position == camera.target)
        return Problem{view, to_text(camera.target) + ", which is the camera's position",
                       "a camera looks from its position to another point",
                       "Move the target, or the position."};
    if (sine_between(camera.target - camera.position, camera.up) < limits::min_sine)
        return Problem{up, to_text(camera.up) + ", which is parallel to the view",
                       "up points away from the line from position to target",
                       "Choose another up, for example [0, 0, 1]."};
    return {};
}

MaybeProblem check_lens(const Camera& camera)
{
    if (!(camera.vertical_fov_degrees > 0 && camera.vertical_fov_degrees < 180))
        return Problem{"/camera/vertical_fov", to_text(camera.vertical_fov_degrees),
                       "an angle of view lies between 0 and 180 degrees, both excluded",
                       "45 is usual."};
    for (const int pixels : camera.resolution)
        if (pixels < 1 || pixels > limits::resolution)
            return Problem{
                "/camera/resolution",
                "[" + to_text(camera.resolution[0]) + ", " + to_text(camera.resolution[1]) + "]",
                "width and height lie between 1 and " + to_text(limits::resolution) + " pixels",
                "Give [width, height] within these limits."};
    return {};
}

MaybeProblem check_outside_lights(const Camera& camera, const Lights& lights, const StopToken& stop)
{
    return first_problem_among(
        lights, stop, [&](const Light& light, std::size_t j) -> MaybeProblem {
            if (length(camera.position - light.center) > light.radius) return {};
            return Problem{"/camera/position",
                           to_text(camera.position) + ", inside light " + to_text(j) +
                               " (counted from 0; center " + to_text(light.center) + ", radius " +
                               to_text(light.radius) + ")",
                           "a camera stands outside all lights, whose inner sides are dark",
                           "Move the camera, or make the light smaller."};
        });
}

MaybeProblem check_camera(const Scene& scene)
{
    if (!scene.camera && scene.probes.empty())
        return Problem{"/camera", "neither a camera nor probes",
                       "a scene has a camera, or probes, or both",
                       "Add a camera, or at least one probe."};
    if (!scene.camera) return {};
    const Camera& camera = *scene.camera;
    return first_problem([&] { return check_position("/camera/position", camera.position); },
                         [&] { return check_position("/camera/target", camera.target); },
                         [&] { return check_view(camera); }, [&] { return check_lens(camera); });
}

MaybeProblem check_unit_vector(const std::string& pointer, const Vec3<double>& v)
{
    constexpr double tolerance = 1e-6;
    if (v == Vec3<double>(0))
        return Problem{pointer, to_text(v), "a direction is not the zero vector",
                       "Write a direction of any length, for example [0, 1, 0]."};
    if (std::abs(length(v) - 1) <= tolerance) return {};
    return Problem{pointer, to_text(v) + ", of length " + to_text(length(v)),
                   "a direction is a unit vector here", "Normalise it."};
}

MaybeProblem check_material_index(const std::string& pointer, int material, const Scene& scene)
{
    const std::size_t count = scene.materials.size();
    if (material >= 0 && static_cast<std::size_t>(material) < count) return {};
    return Problem{pointer, "material " + to_text(material),
                   "the scene has " + to_text(count) + " materials, counted from 0",
                   "Add the material first."};
}

MaybeProblem check_probe(const Probe& probe, const Scene& scene)
{
    return first_problem([&] { return check_position("/position", probe.position); },
                         [&] { return check_unit_vector("/normal", probe.normal); },
                         [&] { return check_unit_vector("/outgoing", probe.outgoing); },
                         [&] { return check_material_index("/material", probe.material, scene); });
}

/// Floats hold d² − r² of a point and a light down to the limit's square. Only of tiny lights can
/// it be less, outside them.
MaybeProblem check_near_lights(const Vec3<double>& x, const Lights& lights,
                               std::span<const std::size_t> tiny, double least,
                               const StopToken& stop)
{
    return first_problem_among(tiny, stop, [&](std::size_t j, std::size_t) -> MaybeProblem {
        const double d = length(x - lights[j].center), r = lights[j].radius;
        if (d <= r || (d - r) * (d + r) >= least * least) return {};
        return Problem{"/position",
                       to_text(x) + ", " + to_text(d) + " from the center of light " + to_text(j) +
                           " (counted from 0), whose radius is " + to_text(r),
                       "the tangents from here to a light are at least " + to_text(least) +
                           " scene units long",
                       "Use smaller units of length."};
    });
}

/// The farthest corner of the box around the camera and the probes is as far as any of them.
MaybeProblem check_far_lights(const Scene& scene, const StopToken& stop)
{
    Vec3<double> low(std::numeric_limits<double>::infinity()), high = -low;
    const auto reach = [&](const Vec3<double>& x) { low = min(low, x), high = max(high, x); };
    if (scene.camera) reach(scene.camera->position);
    for (const Probe& probe : scene.probes) reach(probe.position);
    return first_problem_among(
        scene.lights, stop, [&](const Light& light, std::size_t j) -> MaybeProblem {
            const double d = length(max(light.center - low, high - light.center));
            if (light.radius >= limits::min_radius_over_distance2 * d * d) return {};
            return Problem{
                "/lights/" + to_text(j) + "/radius",
                to_text(light.radius) + ", " + to_text(d) + " from the camera or a probe",
                "a radius over the square of the distance is at least " +
                    to_text(limits::min_radius_over_distance2),
                "Use larger units of length, or a larger radius of the same power."};
        });
}

MaybeProblem check_distances(const Scene& scene, const StopToken& stop)
{
    constexpr double tiny_radius = 1e-9;  // of larger ones, what a double tells apart is enough
    std::vector<std::size_t> tiny;
    for (std::size_t j = 0; j < scene.lights.size(); ++j)
        if (scene.lights[j].radius < tiny_radius) tiny.push_back(j);
    if (tiny.empty()) return {};
    if (scene.camera)  // whose points are not known here, but are no nearer as a rule
        if (MaybeProblem problem = check_near_lights(scene.camera->position, scene.lights, tiny,
                                                     limits::min_camera_tangent, stop))
            return placed_below("/camera", std::move(problem));
    return first_problem_among(scene.probes, stop, [&](const Probe& probe, std::size_t i) {
        return placed_below(
            "/probes/" + to_text(i),
            check_near_lights(probe.position, scene.lights, tiny, limits::min_tangent, stop));
    });
}

// ── materials ──

struct NamedRange {
    double low, high;
    std::string allowed;
};

NamedRange range_of(const MaterialField& field)
{
    const std::string name(field.name);
    if (field.range == FieldRange::zero_to_one) return {0, 1, name + " lies between 0 and 1"};
    if (field.range == FieldRange::above_zero_to_one)
        return {limits::min_alpha, 1,
                name + " is greater than 0 and at most 1; the smallest is " +
                    to_text(limits::min_alpha)};
    return {0, limits::material_number,
            name + " lies between 0 and " + to_text(limits::material_number)};
}

MaybeProblem check_field(const Material& material, const MaterialField& field)
{
    const NamedRange range = range_of(field);
    const auto holds = [&](double x) { return x >= range.low && x <= range.high; };
    const std::string pointer = "/" + std::string(field.name);
    const char* const remedy = "Write a number in this range.";
    if (field.color) {
        const Vec3<double>& color = material.*field.color;
        if (holds(color.x) && holds(color.y) && holds(color.z)) return {};
        const bool grey = color.x == color.y && color.y == color.z;
        return Problem{pointer, grey ? to_text(color.x) : to_text(color), range.allowed, remedy};
    }
    const double number = material.*field.number;
    if (holds(number)) return {};
    return Problem{pointer, to_text(number), range.allowed, remedy};
}

MaybeProblem check_material(const Material& material)
{
    const MaterialType* const type = find_material_type(material.type);
    if (!type)
        return Problem{"/type", "\"" + material.type + "\"",
                       "known types are " + comma_list(material_type_names),
                       did_you_mean(material.type, material_type_names, "Use one of these.")};
    const auto fields = [&] {
        return first_problem_among(
            type->fields, StopToken(),
            [&](const MaterialField& f, std::size_t) { return check_field(material, f); });
    };
    const auto probability = [&]() -> MaybeProblem {
        const double s = material.specular_probability.value_or(0);
        if (!(s >= 0 && s <= 1))
            return Problem{"/specular_probability", to_text(s),
                           "a probability lies between 0 and 1",
                           "Leave it out for the type's own rule."};
        if (material.specular_probability && !type->has_two_lobes)
            return Problem{"/specular_probability", to_text(s),
                           material.type + " has no specular lobe", "Leave it out."};
        return {};
    };
    return first_problem(fields, probability);
}

// ── surfaces ──

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

// ── lights ──

MaybeProblem check_light_count(const Lights& lights)
{
    const std::string allowed = "a scene has between 1 and " + to_text(limits::lights) + " lights";
    if (lights.empty()) return Problem{"/lights", "no lights", allowed, "Add a light."};
    if (lights.size() <= limits::lights) return {};
    return Problem{"/lights", many(lights.size(), "light"), allowed, "Split the scene."};
}

Problem bad_emission(double radius, Emission emission, const Vec3<double>& emitted, bool is_number)
{
    const bool grey = emitted.x == emitted.y && emitted.y == emitted.z,
               is_power = emission == Emission::power;
    const std::string name = is_power ? "power" : "radiance";
    const std::string found = grey ? to_text(emitted.x) : to_text(emitted);
    if (!is_number)
        return {"/" + name, found, "a " + name + " is finite and not negative",
                "Make it positive, or 0 for a black light."};
    return {
        "/" + name, found + ", for a radius of " + to_text(radius),
        "radiance times radius is 0, or lies between " + to_text(limits::min_radiance_radius) +
            " and " + to_text(limits::max_radiance_radius),
        is_power ? "Radiance is power / (4 pi^2 radius^2): use other units." : "Use other units."};
}

MaybeProblem check_emission(double radius, Emission emission, const Vec3<double>& emitted)
{
    constexpr double slack = 1 + 1e-6;  // a limit itself may be rounded up on its way through float
    constexpr double four_pi2 = 4 * std::numbers::pi * std::numbers::pi;
    const double to_radiance_radius =
        emission == Emission::power ? 1 / (four_pi2 * radius) : radius;
    for (const double channel : {emitted.x, emitted.y, emitted.z}) {
        if (!(channel >= 0 && channel <= std::numeric_limits<double>::max()))
            return bad_emission(radius, emission, emitted, false);
        const double kept = channel * to_radiance_radius;
        const bool fits = kept * slack >= limits::min_radiance_radius &&
                          kept <= limits::max_radiance_radius * slack;
        if (channel != 0 && !fits) return bad_emission(radius, emission, emitted, true);
    }
    return {};
}

MaybeProblem check_kept_light(const Light& light)
{
    const Vec3<double> emitted = light.radius > 0 ? radiance(light) : Vec3<double>(0);
    return find_light_problem(light.center, light.radius, Emission::radiance, emitted);
}

}  // namespace

MaybeProblem find_light_problem(const Vec3<double>& center, double radius, Emission emission,
                                const Vec3<double>& emitted)
{
    return first_problem([&] { return check_position("/center", center); },
                         [&] { return check_radius("/radius", radius); },
                         [&] { return check_emission(radius, emission, emitted); });
}

MaybeProblem find_problem(const Scene& scene, const StopToken& stop)
{
    const auto indexed = [](const char* list, std::size_t i, MaybeProblem problem) {
        return problem ? placed_below(list + to_text(i), std::move(problem)) : MaybeProblem{};
    };
    return first_problem(
        [&] { return check_camera(scene); },
        [&] {
            return first_problem_among(scene.probes, stop, [&](const Probe& probe, std::size_t i) {
                return indexed("/probes/", i, check_probe(probe, scene));
            });
        },
        [&] {
            return first_problem_among(
                scene.materials, stop, [](const Material& material, std::size_t) {
                    return placed_below("/materials/" + pointer_token(material.name),
                                        check_material(material));
                });
        },
        [&] {
            return first_problem_among(
                scene.surfaces, stop, [&](const Surface& surface, std::size_t i) {
                    return indexed("/surfaces/", i, check_surface(surface, scene, stop));
                });
        },
        [&] { return check_triangle_count(scene); },
        [&] { return check_light_count(scene.lights); },
        [&] {
            return first_problem_among(scene.lights, stop, [&](const Light& light, std::size_t i) {
                return indexed("/lights/", i, check_kept_light(light));
            });
        },
        [&] {
            return scene.camera ? check_outside_lights(*scene.camera, scene.lights, stop)
                                : MaybeProblem{};
        },
        [&] { return check_distances(scene, stop); },
        [&] { return check_far_lights(scene, stop); });
}

}  // namespace mis
