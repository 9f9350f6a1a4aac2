#pragma once

#include "bsdf.h"
#include "bvh.h"
#include "light.h"

#include <istream>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace host {

/// A pinhole; rays go through the pixels' centres.
struct Camera {
    Vec position, target;
    float vertical_fov = 45;  ///< degrees
    int width = 0, height = 0;

    Ray ray(int column, int row) const
    {
        const Vec forward = unit(target - position), right = unit(cross(forward, {0, 1, 0}));
        const float half = std::tan(vertical_fov * pi / 360);
        const auto w = static_cast<float>(width), h = static_cast<float>(height);
        const float x = (2 * static_cast<float>(column) + 1 - w) / h * half;
        const float y = (h - 1 - 2 * static_cast<float>(row)) / h * half;
        return {position, unit(forward + right * x + cross(right, forward) * y)};
    }
};

/// Where a path meets a surface; its normal is turned to where the path came from. Directions are
/// unit vectors in scene axes.
struct Vertex {
    Vec x;
    Frame frame;
    Vec wo;  ///< in the frame
    const Bsdf* bsdf;

    const Vec& n() const { return frame.z; }
    Vec evaluate(const Vec& wi) const { return bsdf->evaluate(wo, frame.to_local(wi)); }
    float pdf(const Vec& wi) const { return bsdf->pdf(wo, frame.to_local(wi)); }
    Vec sample(float lobe, float u, float v) const
    {
        return frame.to_world(bsdf->sample(wo, lobe, u, v));
    }

    /// Off the surface, towards wi.
    Ray ray(const Vec& wi, float end = std::numeric_limits<float>::infinity()) const
    {
        return {x + n() * 1e-4F, wi, end};
    }
};

struct Scene {
    Camera camera;
    std::vector<std::unique_ptr<Bsdf>> materials;
    std::vector<Light> lights;
    Bvh surfaces{{}};

    /// The nearest light before ray.end, which becomes its distance; nullptr without one.
    const Light* nearest_light(Ray& ray) const
    {
        const Light* found = nullptr;
        for (const Light& light : lights)
            if (const float t = light.hit(ray); t < ray.end) ray.end = t, found = &light;
        return found;
    }
    Vertex vertex(const Ray& ray, int primitive) const
    {
        const Vec x = ray.origin + ray.direction * ray.end;
        const Vec n = surfaces[primitive].normal(x);
        const Frame frame(dot(n, ray.direction) < 0 ? n : -n);
        const auto material = static_cast<std::size_t>(surfaces[primitive].material);
        return {x, frame, frame.to_local(-ray.direction), materials[material].get()};
    }
};

/// The scene of a text: a line per thing, numbers after a word (room.scene shows all of them).
/// Throws std::runtime_error, which names the line.
inline Scene read_scene(std::istream& text)
{
    Scene scene;
    std::map<std::string, int> materials;
    std::vector<Primitive> primitives;
    std::string line;
    for (int number = 1; std::getline(text, line); ++number) {
        std::istringstream words(line);
        std::string word, name;
        if (!(words >> word) || word[0] == '#') continue;
        const auto vec = [&] {
            Vec v;
            words >> v.x >> v.y >> v.z;
            return v;
        };
        const auto scalar = [&] {
            float f = 0;
            words >> f;
            return f;
        };
        const auto add_material = [&](std::unique_ptr<Bsdf> bsdf) {
            materials[name] = static_cast<int>(scene.materials.size());
            scene.materials.push_back(std::move(bsdf));
        };
        const auto add_primitive = [&](Primitive primitive) {
            const auto found = materials.find(name);
            if (found == materials.end()) words.setstate(std::ios::failbit);
            else primitive.material = found->second;
            primitives.push_back(primitive);
        };
        if (word == "camera") {
            scene.camera = {vec(), vec(), scalar(), static_cast<int>(scalar()),
                            static_cast<int>(scalar())};
        } else if (word == "light") {
            scene.lights.push_back({vec(), scalar(), vec()});
        } else if (words >> name; word == "lambert") {
            add_material(std::make_unique<Lambert>(vec()));
        } else if (word == "blinn") {
            const Vec diffuse = vec(), specular = vec();
            add_material(std::make_unique<Blinn>(diffuse, specular, scalar()));
        } else if (word == "sphere") {
            add_primitive({vec(), {}, {}, scalar(), 0});
        } else if (word == "quad") {
            const Vec corner = vec(), a = vec(), b = vec();
            add_primitive({corner, a, b, 0, 0});
            add_primitive({corner + a + b, -a, -b, 0, 0});
        } else {
            words.setstate(std::ios::failbit);
        }
        if (!words) throw std::runtime_error("line " + std::to_string(number) + ": " + line);
    }
    scene.surfaces = Bvh(std::move(primitives));
    return scene;
}

}  // namespace host
