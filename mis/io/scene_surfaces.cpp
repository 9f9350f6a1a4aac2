#include "mis/io/scene_surfaces.h"

#include "mis/io/mesh.h"
#include "mis/io/scene_error.h"
#include "mis/io/scene_file.h"
#include "mis/io/scene_keys.h"
#include "mis/io/text_file.h"
#include "mis/scene/nearest_name.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cassert>

namespace mis {
namespace {

Material read_material(const JsonNode& entry, const std::string& name)
{
    Material material;
    material.name = name;
    material.type = read_type(entry["type"], material_type_names);
    const MaterialType* const type = find_material_type(material.type);
    assert(type);
    entry.require_keys(scene_keys::material(*type));
    for (const MaterialField& field : type->fields) {
        const std::optional<JsonNode> value =
            field.required ? entry[field.name] : entry.find(field.name);
        if (!value) continue;
        if (field.color) material.*field.color = value->color();
        else material.*field.number = value->number();
    }
    if (const auto probability = entry.find("specular_probability"))
        material.specular_probability = probability->number();
    return material;
}

Vec3<double> read_scale(const JsonNode& scale)
{
    const std::optional<double> number = scale.maybe_number();
    const Vec3<double> factors = number ? Vec3<double>(*number) : scale.color();
    if (factors.x == 0 || factors.y == 0 || factors.z == 0)
        scale.fail_value("a scale is not 0", "1 leaves the mesh as it is.");
    return factors;
}

Transform read_transform(const JsonNode& entry)
{
    entry.require_keys(scene_keys::transform);
    const auto scale = entry.find("scale"), rotate = entry.find("rotate"),
               translate = entry.find("translate");
    return {scale ? read_scale(*scale) : Vec3<double>(1),
            rotate ? rotate->vector() : Vec3<double>(0),
            translate ? translate->vector() : Vec3<double>(0)};
}

Mesh read_mesh_surface(const JsonNode& entry, const StopToken& stop)
{
    stop.check();
    entry.require_keys(scene_keys::mesh);
    const JsonNode name = entry["file"];
    const std::optional<JsonNode> transform = entry.find("transform");
    const Transform placed = transform ? read_transform(*transform) : Transform();
    const std::filesystem::path file = referenced_file(name);
    try {
        return read_mesh(file, placed, stop);
    } catch (const SceneError& error) {
        const Problem& problem = error.problem;
        if (!problem.pointer.empty()) throw;  // with the mesh's own name, line and column
        name.fail(in_quotes(name.string()) + ", " + problem.found, problem.allowed, problem.remedy);
    }
}

SphereSurface read_sphere(const JsonNode& entry)
{
    entry.require_keys(scene_keys::sphere);
    return {entry["center"].vector(), entry["radius"].number()};
}

Quad read_quad(const JsonNode& entry)
{
    entry.require_keys(scene_keys::quad);
    const JsonNode edges = entry["edges"];
    edges.require_array(2, "two edges, [[x, y, z], [x, y, z]], belong here");
    return {entry["corner"].vector(), {edges.element(0).vector(), edges.element(1).vector()}};
}

}  // namespace

std::vector<Material> read_materials(const JsonNode& materials)
{
    materials.require_object();
    std::vector<Material> read;
    for (const auto& [name, entry] : materials.value().items())
        read.push_back(read_material(materials.at(name, entry), name));
    return read;
}

int read_material_name(const JsonNode& name, const std::vector<Material>& materials)
{
    const std::string& written = name.string();
    const auto by_name = [](const Material& m) -> const std::string& { return m.name; };
    const auto found = std::ranges::lower_bound(materials, written, {}, by_name);
    if (found != materials.end() && found->name == written)
        return static_cast<int>(found - materials.begin());
    std::vector<std::string_view> known(materials.size());
    std::ranges::transform(materials, known.begin(), by_name);
    name.fail(in_quotes(written),
              known.empty() ? "the scene has no materials"
                            : "the scene's materials are " + comma_list(known),
              did_you_mean(written, known, "Add it to \"materials\"."));
}

Surface read_surface(const JsonNode& entry, const std::vector<Material>& materials,
                     const StopToken& stop)
{
    const std::string_view type = read_type(entry["type"], scene_keys::surface_types);
    const auto place = [&](auto shape) {
        return Surface{std::move(shape), read_material_name(entry["material"], materials)};
    };
    if (type == "sphere") return place(read_sphere(entry));
    if (type == "quad") return place(read_quad(entry));
    return place(read_mesh_surface(entry, stop));
}

}  // namespace mis
