#include "mis/scene/rules.h"

#include "mis/scene/text.h"

#include <cmath>

namespace mis {

namespace {

bool is_finite(const Vec3<double>& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

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

}  // namespace

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

MaybeProblem check_probe(const Probe& probe, const Scene& scene)
{
    return first_problem([&] { return check_position("/position", probe.position); },
                         [&] { return check_unit_vector("/normal", probe.normal); },
                         [&] { return check_unit_vector("/outgoing", probe.outgoing); },
                         [&] { return check_material_index("/material", probe.material, scene); });
}

}  // namespace mis
