#include "bench/random_scene.h"

#include "mis/io/random_lights.h"

#include <cmath>

namespace mis::bench {

namespace {
void add_tower(Scene& scene, double x, double z)
{
    const double side = 0.8, height = 3;
    const auto wall = [&](Vec3<double> corner, Vec3<double> along) {
        scene.surfaces.push_back({Quad{corner, {along, Vec3<double>{0, height, 0}}}, 0});
    };
    wall({x, 0, z}, {side, 0, 0});
    wall({x, 0, z}, {0, 0, side});
    wall({x + side, 0, z}, {0, 0, side});
    wall({x, 0, z + side}, {side, 0, 0});
}
}  // namespace

Scene random_scene(std::size_t count, Layout layout)
{
    Scene scene;
    scene.name = "random";
    scene.camera = Camera{.position = {0, 8, 22}, .target = {0, 1, 0}, .resolution = {128, 96}};
    Material material{.name = "ground", .type = "blinn"};
    material.diffuse = Vec3<double>(0.4), material.specular = Vec3<double>(0.2);
    material.exponent = 200;
    scene.materials.push_back(material);
    scene.surfaces.push_back({Quad{{-20, 0, -20}, {Vec3<double>{0, 0, 40}, {40, 0, 0}}}, 0});
    for (int i = 0; i < 12; ++i) add_tower(scene, -12 + 8 * (i % 4), -9 + 8 * (i / 4));
    const double smallest = 0.02 * std::sqrt(1000 / static_cast<double>(count));
    append_random_lights(
        {.count = count,
         .seed = 1,
         .box = {Vec3<double>{-18, 4, -18}, {18, layout == Layout::cloud ? 8 : 4.05, 18}},
         .radius = {smallest, 10 * smallest},
         .power = {1, 100}},
        scene.lights);
    return scene;
}

}  // namespace mis::bench
