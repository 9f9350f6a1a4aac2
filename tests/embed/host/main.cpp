// A small renderer: reads a scene of spheres, quads and spherical lights, writes a picture.
#include "integrator.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace {

using namespace host;  // NOLINT: its program

/// Mean radiance of every pixel, row by row from the top.
std::vector<Vec> render(const Scene& scene, int samples, int bounces)
{
    Integrator integrator(scene);
    const Camera& camera = scene.camera;
    std::vector<Vec> picture;
    for (int row = 0; row < camera.height; ++row)
        for (int column = 0; column < camera.width; ++column) {
            Random random(1, picture.size());
            Vec sum;
            for (int k = 0; k < samples; ++k)
                sum += integrator.radiance(camera.ray(column, row), bounces, random);
            picture.push_back(sum * (1 / static_cast<float>(samples)));
        }
    return picture;
}

/// As PFM: rows from the bottom, little-endian floats.
void write_pfm(const std::string& file, const Camera& camera, const std::vector<Vec>& picture)
{
    std::ofstream out(file, std::ios::binary);
    out << "PF\n" << camera.width << ' ' << camera.height << "\n-1\n";
    const auto bytes = static_cast<std::streamsize>(sizeof(Vec)) * camera.width;
    for (int row = camera.height - 1; row >= 0; --row)
        out.write(
            reinterpret_cast<const char*>(&picture[static_cast<std::size_t>(row * camera.width)]),
            bytes);
    if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv)
{
    try {
        const int samples = argc > 3 ? std::atoi(argv[3]) : 16;
        const int bounces = argc > 4 ? std::atoi(argv[4]) : 3;
        if (argc < 3 || argc > 5 || samples < 1 || bounces < 0)
            throw std::runtime_error("SCENE OUT.pfm [SAMPLES [BOUNCES]]");
        std::ifstream text(argv[1]);
        if (!text) throw std::runtime_error(std::string(argv[1]) + ": cannot be read");
        const Scene scene = read_scene(text);
        write_pfm(argv[2], scene.camera, render(scene, samples, bounces));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s: %s\n", argv[0], error.what());
        return 2;
    }
}
