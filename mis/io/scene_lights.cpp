#include "mis/io/scene_lights.h"

#include "mis/io/random_lights.h"
#include "mis/io/scene_error.h"
#include "mis/io/scene_file.h"
#include "mis/io/scene_keys.h"
#include "mis/io/table_csv.h"
#include "mis/scene/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {
namespace {

void require_valid(const JsonNode& entry, const Vec3<double>& center, double radius,
                   Emission emission, const Vec3<double>& emitted)
{
    std::optional<Problem> problem = find_light_problem(center, radius, emission, emitted);
    if (!problem) return;
    problem->pointer.insert(0, entry.pointer());
    throw SceneError(entry.file(), *problem);
}

void require_room(const JsonNode& entry, std::size_t more, const Lights& lights)
{
    if (more <= limits::lights - lights.size()) return;
    entry.fail(fmt::format("{}, after {} before", many(more, "light"), lights.size()),
               fmt::format("a scene has at most {} lights", limits::lights), "Split the scene.");
}

void append_sphere(const JsonNode& entry, Lights& to)
{
    entry.require_keys(scene_keys::light);
    const std::optional<JsonNode> radiance = entry.find("radiance"), power = entry.find("power");
    if (bool(radiance) == bool(power))
        entry.fail(
            radiance ? "both \"radiance\" and \"power\"" : "neither \"radiance\" nor \"power\"",
            "a light has one of \"radiance\" and \"power\"",
            radiance ? "Remove one of the two." : "Add one of the two.");
    const Vec3<double> center = entry["center"].vector();
    const double radius = entry["radius"].number();
    const Vec3<double> emitted = (radiance ? *radiance : *power).color();
    require_valid(entry, center, radius, radiance ? Emission::radiance : Emission::power, emitted);
    require_room(entry, 1, to);
    to.push_back(radiance ? make_light(center, radius, emitted)
                          : make_light_of_power(center, radius, emitted));
}

void append_table(const JsonNode& entry, Lights& to, const StopToken& stop)
{
    entry.require_keys(scene_keys::table);
    append_light_table(referenced_file(entry["file"]), to, stop);
}

std::array<double, 2> read_range(const JsonNode& range)
{
    const char* const allowed = "two numbers, [low, high], 0 < low <= high, belong here";
    range.require_array(2, allowed);
    const std::array<double, 2> ends{range.element(0).number(), range.element(1).number()};
    if (!(ends[0] > 0 && ends[0] <= ends[1]))
        range.fail_value(allowed, "A range of one value is written twice: [1, 1].");
    return ends;
}

std::array<Vec3<double>, 2> read_box(const JsonNode& box)
{
    const char* const allowed =
        "two corners, [[x, y, z], [x, y, z]], the lowest first, belong here";
    box.require_array(2, allowed);
    const std::array<Vec3<double>, 2> corners{box.element(0).vector(), box.element(1).vector()};
    const auto& [low, high] = corners;
    if (!(low.x <= high.x && low.y <= high.y && low.z <= high.z))
        box.fail("a first corner that is above the second in x, y or z", allowed,
                 "Sort each coordinate.");
    return corners;
}

void append_random(const JsonNode& entry, Lights& to, const StopToken& stop)
{
    entry.require_keys(scene_keys::random);
    const RandomLights lights{
        .count = entry["count"].whole_number(1, limits::lights),
        .seed = entry["seed"].whole_number(0, std::numeric_limits<std::uint64_t>::max()),
        .box = read_box(entry["box"]),
        .radius = read_range(entry["radius"]),
        .power = read_range(entry["power"]),
    };
    for (const Vec3<double>& corner : lights.box)
        if (std::max({std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)}) > limits::length)
            entry["box"].fail(
                "a coordinate beyond the limit",
                "a coordinate lies within ±" + to_text(limits::length) + " scene units",
                "Use larger units.");
    // The extremes in radiance are the corners of (radius, power); if all four may be, so may what
    // lies between.
    for (const double radius : lights.radius)
        for (const double power : lights.power)
            require_valid(entry, lights.box[0], radius, Emission::power, Vec3<double>(power));
    require_room(entry["count"], lights.count, to);
    append_random_lights(lights, to, stop);
}

}  // namespace

void append_lights(const JsonNode& entry, Lights& to, const StopToken& stop)
{
    entry.require_object();
    const std::optional<JsonNode> type = entry.find("type");
    const std::string_view name = type ? read_type(*type, scene_keys::light_types) : "sphere";
    if (name == "sphere") append_sphere(entry, to);
    else if (name == "table") append_table(entry, to, stop);
    else append_random(entry, to, stop);
}

}  // namespace mis
