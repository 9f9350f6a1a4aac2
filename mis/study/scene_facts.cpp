#include "mis/study/scene_facts.h"

#include <variant>

namespace mis {
namespace {

std::size_t triangles_of(const Scene& scene)
{
    std::size_t triangles = 0;
    for (const Surface& surface : scene.surfaces)
        if (const auto* mesh = std::get_if<Mesh>(&surface.shape))
            triangles += mesh->triangles.size();
    return triangles;
}

}  // namespace

SceneFacts facts_of(const Scene& scene, const StudyPoints& points)
{
    return {.file = scene.file,
            .name = scene.name,
            .lights = scene.lights.size(),
            .surfaces = scene.surfaces.size(),
            .triangles = triangles_of(scene),
            .width = points.shading.width,
            .height = points.shading.height,
            .shading_points = points.figure_points,
            .background_pixels = points.shading.background.size()};
}

}  // namespace mis
