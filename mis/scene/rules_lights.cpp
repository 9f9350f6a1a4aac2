#include "mis/scene/rules.h"

#include "mis/scene/text.h"

#include <limits>
#include <numbers>

namespace mis {

MaybeProblem check_light_count(const Lights& lights)
{
    const std::string allowed = "a scene has between 1 and " + to_text(limits::lights) + " lights";
    if (lights.empty()) return Problem{"/lights", "no lights", allowed, "Add a light."};
    if (lights.size() <= limits::lights) return {};
    return Problem{"/lights", many(lights.size(), "light"), allowed, "Split the scene."};
}

namespace {

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

}  // namespace

std::optional<Problem> find_light_problem(const Vec3<double>& center, double radius,
                                          Emission emission, const Vec3<double>& emitted)
{
    return first_problem([&] { return check_position("/center", center); },
                         [&] { return check_radius("/radius", radius); },
                         [&] { return check_emission(radius, emission, emitted); });
}

MaybeProblem check_kept_light(const Light& light)
{
    const Vec3<double> emitted = light.radius > 0 ? radiance(light) : Vec3<double>(0);
    return find_light_problem(light.center, light.radius, Emission::radiance, emitted);
}

}  // namespace mis
