#include "tests/support/scene_text.h"

#include "mis/scene/material_fields.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ranges>
#include <stdexcept>

namespace mis {

namespace {

/// Shortest text that reads back to the same double.
std::string text(double x) { return fmt::format("{}", x); }
std::string text(const Vec3<double>& v) { return fmt::format("[{}, {}, {}]", v.x, v.y, v.z); }

std::string text(const Material& material)
{
    std::string fields = fmt::format(R"("type": "{}")", material.type);
    for (const MaterialField& field : find_material_type(material.type)->fields)
        fields +=
            fmt::format(R"(, "{}": {})", field.name,
                        field.color ? text(material.*field.color) : text(material.*field.number));
    if (material.specular_probability)
        fields += fmt::format(R"(, "specular_probability": {})", *material.specular_probability);
    return fmt::format("{{ {} }}", fields);
}

/// A material's key: its place in the list.
std::string key(int material) { return fmt::format("m{}", material); }

std::string text(const Probe& probe)
{
    return fmt::format(R"({{ "position": {}, "normal": {}, "outgoing": {}, "material": "{}" }})",
                       text(probe.position), text(probe.normal), text(probe.outgoing),
                       key(probe.material));
}

std::string text(const Surface& surface)
{
    if (const auto* sphere = std::get_if<SphereSurface>(&surface.shape))
        return fmt::format(
            R"({{ "type": "sphere", "center": {}, "radius": {}, "material": "{}" }})",
            text(sphere->center), sphere->radius, key(surface.material));
    if (const auto* quad = std::get_if<Quad>(&surface.shape))
        return fmt::format(
            R"({{ "type": "quad", "corner": {}, "edges": [{}, {}], "material": "{}" }})",
            text(quad->corner), text(quad->edges[0]), text(quad->edges[1]), key(surface.material));
    throw std::invalid_argument("a mesh lies in a file of its own");
}

std::string text(const Light& light)
{
    return fmt::format(R"({{ "center": {}, "radius": {}, "radiance": {} }})", text(light.center),
                       light.radius, text(radiance(light)));
}

std::string list(const std::ranges::range auto& all)
{
    std::vector<std::string> texts;
    for (const auto& one : all) texts.push_back(text(one));
    return fmt::format("[\n    {}\n  ]", fmt::join(texts, ",\n    "));
}

}  // namespace

std::string scene_text(const Scene& scene)
{
    if (scene.camera) throw std::invalid_argument("no scene with a camera is written");
    std::vector<std::string> materials;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        materials.push_back(
            fmt::format(R"("{}": {})", key(static_cast<int>(i)), text(scene.materials[i])));
    return fmt::format(R"({{
  "format": "mis-scene/1",
  "name": "{}",
  "probes": {},
  "materials": {{
    {}
  }},
  "surfaces": {},
  "lights": {}
}}
)",
                       scene.name, list(scene.probes), fmt::join(materials, ",\n    "),
                       list(scene.surfaces), list(scene.lights));
}

}  // namespace mis
