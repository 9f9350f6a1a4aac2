#pragma once

#include "mis/report/field.h"

#include <concepts>
#include <cstddef>
#include <string>

namespace mis {

/// What a report says of a scene, before anything is sampled.
struct SceneFacts {
    std::string file, name;
    std::size_t lights = 0, surfaces = 0, triangles = 0;
    int width = 0, height = 0;  ///< 0 without a camera
    std::size_t shading_points = 0, background_pixels = 0;
};

template <class Visitor, class S>
requires std::derived_from<S, SceneFacts>
void describe_facts(Visitor& v, S& scene)
{
    v.text(Field("file"), scene.file);
    v.text(Field("name"), scene.name);
    v.count(Field("lights"), scene.lights);
    v.count(Field("surfaces"), scene.surfaces);
    v.count(Field("triangles"), scene.triangles);
    v.resolution(Field("resolution", unit::pixels), scene.width, scene.height);
    v.count(Field("shading_points"), scene.shading_points);
    v.count(Field("background_pixels"), scene.background_pixels);
}

}  // namespace mis
