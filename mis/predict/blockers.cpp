#include "mis/predict/blockers.h"

#include "mis/predict/predict.h"
#include "mis/trace/intersect.h"

#include <array>
#include <cmath>
#include <string>

namespace mis {

namespace {

/// A flat convex piece of a surface: three or four corners.
struct Face {
    std::array<Vec3<double>, 4> corners;
    std::size_t count;
    double rounding;  ///< how far off its plane a point counts as on it; scene units
};

bool is_below_horizon(const Face& face, const Probe& probe)
{
    for (std::size_t i = 0; i < face.count; ++i)
        if (dot(face.corners[i] - probe.position, probe.normal) > face.rounding) return false;
    return true;
}

bool is_beyond(const Face& face, const Probe& probe, const Light& light)
{
    const Vec3<double> to_center = light.center - probe.position;
    const double d = length(to_center);
    for (std::size_t i = 0; i < face.count; ++i)
        if (dot(face.corners[i] - probe.position, to_center) < (d + light.radius) * d) return false;
    return true;
}

bool has_both_on_one_side(const Face& face, const Probe& probe, const Light& light)
{
    const Vec3<double> across =
        cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
    const double size = length(across);
    if (!(size > 0)) return true;  // no area
    const double point = dot(probe.position - face.corners[0], across) / size;
    const double center = dot(light.center - face.corners[0], across) / size;
    const double side = std::abs(point) > face.rounding ? point : center;
    return (side > 0 ? center : -center) >= light.radius * (1 - 1e-12) &&
           (side > 0 ? point : -point) >= -face.rounding;
}

bool is_light_below(const Light& light, const Probe& probe)
{
    return dot(light.center - probe.position, probe.normal) <= -light.radius;
}

bool could_hide(const Face& face, const Scene& scene, const Probe& probe, StopEvery& check)
{
    if (is_below_horizon(face, probe)) return false;
    for (const Light& light : scene.lights) {
        check();
        if (!is_light_below(light, probe) && !is_beyond(face, probe, light) &&
            !has_both_on_one_side(face, probe, light))
            return true;
    }
    return false;
}

[[noreturn]] void refuse(std::size_t surface, const char* what)
{
    throw PredictError(
        "surface " + std::to_string(surface) + " is a " + what +
        " that could hide a light from the probe; predict can integrate spheres only\n"
        "    Remove the surface, or measure with compare.");
}

}  // namespace

void refuse_blockers(const Scene& scene, const Probe& probe, const StopToken& stop)
{
    StopEvery check(stop, 4096);
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
        const auto& shape = scene.surfaces[s].shape;
        const auto rounding = [&](const Vec3<double>& corner) {
            return 4 * float_offset(std::max(largest_coordinate(corner),
                                             largest_coordinate(probe.position)));
        };
        if (const auto* quad = std::get_if<Quad>(&shape)) {
            const Vec3<double> opposite = quad->corner + quad->edges[0] + quad->edges[1];
            const Face face{{quad->corner, quad->corner + quad->edges[0], opposite,
                             quad->corner + quad->edges[1]},
                            4,
                            std::max(rounding(quad->corner), rounding(opposite))};
            if (could_hide(face, scene, probe, check)) refuse(s, "quad");
        } else if (const auto* mesh = std::get_if<Mesh>(&shape)) {
            for (const auto& [a, b, c] : mesh->triangles) {
                check();
                const Face face{{mesh->positions[a], mesh->positions[b], mesh->positions[c]},
                                3,
                                rounding(mesh->positions[a])};
                if (could_hide(face, scene, probe, check)) refuse(s, "mesh");
            }
        }
    }
}

}  // namespace mis
