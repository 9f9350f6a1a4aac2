#include "mis/io/scene_json.h"

#include "mis/io/json_node.h"
#include "mis/io/scene_keys.h"
#include "mis/io/scene_lights.h"
#include "mis/io/scene_surfaces.h"
#include "mis/io/text_file.h"
#include "mis/scene/direction.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mis {
namespace {

void require_format(const JsonNode& format)
{
    if (format.string() != scene_keys::format)
        format.fail_value(fmt::format("this version reads \"{}\"", scene_keys::format),
                          "See docs/scene-format.md.");
}

Camera read_camera(const JsonNode& entry)
{
    entry.require_keys(scene_keys::camera);
    Camera camera;
    camera.position = entry["position"].vector();
    camera.target = entry["target"].vector();
    if (const auto up = entry.find("up")) camera.up = unit_or_zero(up->vector());
    if (const auto fov = entry.find("vertical_fov")) camera.vertical_fov_degrees = fov->number();
    if (const auto resolution = entry.find("resolution")) {
        resolution->require_array(2, "two whole numbers, [width, height], belong here");
        camera.resolution = {resolution->element(0).pixels(), resolution->element(1).pixels()};
    }
    return camera;
}

Probe read_probe(const JsonNode& entry, const std::vector<Material>& materials)
{
    entry.require_keys(scene_keys::probe);
    return {entry["position"].vector(), unit_or_zero(entry["normal"].vector()),
            unit_or_zero(entry["outgoing"].vector()),
            read_material_name(entry["material"], materials)};
}

/// Calls `read` for each element of the member `key`, if there is one.
template <class Read>
void for_each_element(const JsonNode& root, std::string_view key, const StopToken& stop,
                      const Read& read)
{
    const std::optional<JsonNode> list = root.find(key);
    if (!list) return;
    StopEvery check(stop, 1024);
    for (std::size_t i = 0; i < list->size(); ++i) check(), read(list->element(i));
}

}  // namespace

Scene parse_scene(std::string_view text, const std::filesystem::path& file, const StopToken& stop)
{
    Scene scene;
    scene.file = file.string();
    const auto add_lights = [&](const Json& document, std::size_t index, const Json& entry) {
        const JsonNode root(document, scene.file);
        if (index == 0)
            if (const auto format = root.find("format"))
                require_format(*format);  // another format's lights may be others
        const JsonNode lights = root["lights"];
        append_lights(lights.at(index, entry), scene.lights, stop);
    };
    const Json document = parse_json(text, file, "lights", add_lights, stop);
    const JsonNode root(document, scene.file);
    root.require_object();
    require_format(root["format"]);
    root.require_keys(scene_keys::scene);
    if (const auto schema = root.find("$schema")) (void)schema->string();  // for editors
    const auto name = root.find("name");
    scene.name = name ? name->string() : file.stem().string();
    if (const auto camera = root.find("camera")) scene.camera = read_camera(*camera);
    if (const auto materials = root.find("materials")) scene.materials = read_materials(*materials);
    for_each_element(root, "probes", stop, [&](const JsonNode& probe) {
        scene.probes.push_back(read_probe(probe, scene.materials));
    });
    for_each_element(root, "surfaces", stop, [&](const JsonNode& surface) {
        scene.surfaces.push_back(read_surface(surface, scene.materials, stop));
    });
    for_each_element(root, "lights", stop,
                     [](const JsonNode&) {});  // an array; its elements were read on the way
    if (const std::optional<Problem> problem = find_problem(scene, stop))
        throw SceneError(scene.file, *problem);
    return scene;
}

Scene read_scene(const std::filesystem::path& file, const StopToken& stop)
{
    return parse_scene(read_text_file(file, "scene", stop), file, stop);
}

}  // namespace mis
