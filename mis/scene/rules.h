#pragma once

#include "mis/math/stop_token.h"
#include "mis/scene/validate.h"

#include <cstddef>
#include <optional>
#include <string>

namespace mis {

// What find_problem() asks of a scene, one file for each kind of thing, and what their rules share.
// Pointers are relative to the thing, unless it stands once in a scene.

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

/// The same problem with `pointer` before its own, where there is one.
inline MaybeProblem placed_below(const std::string& pointer, MaybeProblem problem)
{
    if (problem) problem->pointer.insert(0, pointer);
    return problem;
}

// What several kinds of things have.

/// Are all coordinates numbers within limits::length?
bool is_position(const Vec3<double>& p);
/// That rule in words.
std::string coordinates_allowed();
MaybeProblem check_position(const std::string& pointer, const Vec3<double>& position);
MaybeProblem check_radius(const std::string& pointer, double radius);
/// Does the scene have that material?
MaybeProblem check_material_index(const std::string& pointer, int material, const Scene& scene);
/// Sine of the angle between two vectors of any finite length; 0 where one of them is 0.
double sine_between(const Vec3<double>& a, const Vec3<double>& b);

// rules_points.cpp: what looks?

/// The camera, and that there is one, or probes.
MaybeProblem check_camera(const Scene& scene);
/// One probe; relative to it.
MaybeProblem check_probe(const Probe& probe, const Scene& scene);

// rules_materials.cpp

/// One material; relative to it.
MaybeProblem check_material(const Material& material);

// rules_surfaces.cpp

/// One surface; relative to it.
MaybeProblem check_surface(const Surface& surface, const Scene& scene, const StopToken& stop);
/// Of all meshes together.
MaybeProblem check_triangle_count(const Scene& scene);

// rules_lights.cpp, as find_light_problem()

MaybeProblem check_light_count(const Lights& lights);
/// One light as a scene keeps it; relative to it.
MaybeProblem check_kept_light(const Light& light);

// rules_distances.cpp: do lights and what looks at them stand so that floats hold their caps?

/// Does the camera stand outside all lights?
MaybeProblem check_outside_lights(const Camera& camera, const Lights& lights,
                                  const StopToken& stop);
/// Tiny lights close to the camera or a probe.
MaybeProblem check_near_lights(const Scene& scene, const StopToken& stop);
/// Small lights far from the camera or a probe.
MaybeProblem check_far_lights(const Scene& scene, const StopToken& stop);

}  // namespace mis
