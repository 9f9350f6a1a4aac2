#include "mis/scene/rules.h"

#include "mis/scene/text.h"

#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace mis {

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

namespace {

/// Floats hold d² − r² of a point and a light down to the limit's square. Only of tiny lights can
/// it be less, outside them.
MaybeProblem check_tangents(const Vec3<double>& x, const Lights& lights,
                            std::span<const std::size_t> tiny, double least, const StopToken& stop)
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

}  // namespace

MaybeProblem check_near_lights(const Scene& scene, const StopToken& stop)
{
    constexpr double tiny_radius = 1e-9;  // of larger ones, what a double tells apart is enough
    std::vector<std::size_t> tiny;
    for (std::size_t j = 0; j < scene.lights.size(); ++j)
        if (scene.lights[j].radius < tiny_radius) tiny.push_back(j);
    if (tiny.empty()) return {};
    if (scene.camera)  // whose points are not known here, but are no nearer as a rule
        if (MaybeProblem problem = check_tangents(scene.camera->position, scene.lights, tiny,
                                                  limits::min_camera_tangent, stop))
            return placed_below("/camera", std::move(problem));
    return first_problem_among(scene.probes, stop, [&](const Probe& probe, std::size_t i) {
        return placed_below(
            "/probes/" + to_text(i),
            check_tangents(probe.position, scene.lights, tiny, limits::min_tangent, stop));
    });
}

MaybeProblem check_far_lights(const Scene& scene, const StopToken& stop)
{
    // The farthest corner of the box around the camera and the probes is as far as any of them.
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

}  // namespace mis
