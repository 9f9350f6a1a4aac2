#include "tests/support/scenes.h"

#include "tests/support/uniforms.h"

namespace mis {

Lights thirty_lights_one_dark()
{
    Uniforms uniforms(30);
    Lights lights;
    for (int j = 0; j < 30; ++j) {
        const double distance = uniforms.between(2, 9), radius = uniforms.log_between(1e-3, 1);
        const Vec3<double> radiance{uniforms.log_between(0.1, 100), uniforms.log_between(0.1, 100),
                                    uniforms.log_between(0.1, 100)};
        lights.push_back(make_light(uniforms.direction() * distance, radius,
                                    j == 6 ? Vec3<double>(0) : radiance));
    }
    return lights;
}

ShadingPoint point_facing_up()
{
    const Vec3<double> wo = normalized(Vec3<double>{0.6, 0.7, 0.2});
    return {.x = {0, 0, 0},
            .n = {0, 1, 0},
            .wo = vec_cast<float>(wo),
            .ray_origin = {0, 0, 0},
            .id = 3};
}

namespace {

Material two_lobes(std::string_view type, Vec3<double> diffuse, Vec3<double> specular,
                   double exponent, double alpha)
{
    return {.type = std::string(type),
            .diffuse = diffuse,
            .specular = specular,
            .exponent = exponent,
            .alpha = alpha};
}

}  // namespace

std::vector<Material> materials_of(std::string_view type)
{
    const Vec3<double> black(0), some(0.3), much(0.6), reddish{0.7, 0.3, 0.1};
    if (type == "lambert")
        return {two_lobes(type, much, black, 0, 0), two_lobes(type, reddish, black, 0, 0)};
    std::vector<Material> list;
    if (type == "ggx") {
        for (const double alpha : {1.0, 0.3, 0.05, 1e-4}) {
            list.push_back(two_lobes(type, some, reddish, 0, alpha));
            list.push_back(two_lobes(type, black, much, 0, alpha));
        }
        list.push_back(two_lobes(type, some, black, 0, 0.2));
        list.push_back(two_lobes(type, black, black, 0, 0.2));
        return list;
    }
    for (const double m : {0.0, 1.0, 20.0, 1000.0, 1e6}) {
        list.push_back(two_lobes(type, some, reddish, m, 0));
        list.push_back(two_lobes(type, black, much, m, 0));
    }
    list.push_back(two_lobes(type, reddish, black, 50, 0));
    return list;
}

Lights three_lights_apart()
{
    return {make_light({0, 3, 0.5}, 0.8, Vec3<double>(2)), make_light({2, 2, -1}, 0.3, {9, 6, 3}),
            make_light({-1.5, 1.8, 0}, 0.5, Vec3<double>(4))};
}

Lights eclipse()
{
    const Vec3<double> axis = normalized(Vec3<double>{1, 3, 0.5});
    return {make_light(axis * 6.0, 1.5, Vec3<double>(2)),
            make_light(axis * 2.5, 0.3, Vec3<double>(5)),
            make_light({-2, 2, 0}, 0.4, Vec3<double>(3))};
}

Scene probe_under(const Lights& lights, const Material& material)
{
    const ShadingPoint point = point_facing_up();
    Scene scene;
    scene.probes = {{point.x, vec_cast<double>(point.n), vec_cast<double>(point.wo), 0}};
    scene.materials = {material};
    scene.lights = lights;
    return scene;
}

Material grey_floor() { return {.name = "floor", .type = "lambert", .diffuse = Vec3<double>(0.5)}; }

Vec3<double> irradiance(const Light& light, const Vec3<double>& x, const Vec3<double>& n)
{
    const Vec3<double> to_center = light.center - x;
    const double sin_max = light.radius / length(to_center);
    return radiance(light) * (std::numbers::pi * sin_max * sin_max * dot(normalized(to_center), n));
}

}  // namespace mis
