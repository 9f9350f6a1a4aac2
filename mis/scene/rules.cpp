#include "mis/scene/rules.h"

#include "mis/scene/direction.h"
#include "mis/scene/text.h"

#include <cmath>

namespace mis {

bool is_position(const Vec3<double>& p)
{
    const auto in_range = [](double x) { return std::abs(x) <= limits::length; };  // false for NaN
    return in_range(p.x) && in_range(p.y) && in_range(p.z);
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

MaybeProblem check_material_index(const std::string& pointer, int material, const Scene& scene)
{
    const std::size_t count = scene.materials.size();
    if (material >= 0 && static_cast<std::size_t>(material) < count) return {};
    return Problem{pointer, "material " + to_text(material),
                   "the scene has " + to_text(count) + " materials, counted from 0",
                   "Add the material first."};
}

double sine_between(const Vec3<double>& a, const Vec3<double>& b)
{
    return length(cross(unit_or_zero(a), unit_or_zero(b)));
}

}  // namespace mis
