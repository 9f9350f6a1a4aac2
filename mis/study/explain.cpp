#include "mis/study/explain.h"

#include "mis/math/limits.h"
#include "mis/math/stable.h"
#include "mis/study/savings.h"

#include <algorithm>

namespace mis {

namespace {

void count_lights(Explanation& found, const Lights& lights)
{
    found.lights = lights.size();
    found.radius = found.power = {infinity, 0};
    for (const Light& light : lights) {
        const double power = luminance_radius(light) * light.radius * 4 * square(pi<double>);
        found.black_lights += power > 0 ? 0 : 1;
        found.radius = {std::min(found.radius.low, light.radius),
                        std::max(found.radius.high, light.radius)};
        found.power = {std::min(found.power.low, power), std::max(found.power.high, power)};
    }
}

void count_surfaces(Explanation& found, const std::vector<Surface>& surfaces)
{
    for (const Surface& surface : surfaces) {
        found.quads += std::holds_alternative<Quad>(surface.shape) ? 1 : 0;
        found.spheres += std::holds_alternative<SphereSurface>(surface.shape) ? 1 : 0;
        if (const auto* mesh = std::get_if<Mesh>(&surface.shape))
            ++found.meshes, found.triangles += mesh->triangles.size();
    }
}

/// Adds the points of a band, or the probes, to what was found; shares: sums over tiles, so far.
void count_points(Explanation& found, const LitScene& lit, const GBuffer& shading,
                  EffectShares& sums)
{
    sums.add(lit.tiles_that_call(shading));
    found.shading_points += shading.points.size() + shading.dark.size();
    found.dark_points += shading.dark.size();
    found.counts.add(shading.counts);
    found.background_pixels += shading.background.size();
    found.tiles += shading.tiles.size();
    for (const Tile& tile : shading.tiles)
        found.materials[static_cast<std::size_t>(tile.material)].shading_points += tile.count;
}

}  // namespace

Explanation explain(const LitScene& lit, const AnyExecutor& executor, const StopToken& stop)
{
    const Scene& scene = lit.scene();
    Explanation found;
    found.file = scene.file;
    found.name = scene.name;
    count_lights(found, scene.lights);
    count_surfaces(found, scene.surfaces);
    for (const Material& material : scene.materials)
        found.materials.push_back({material.name, material.type, 0});
    EffectShares sums;
    GBuffer some;  // of the picture's middle band, or of the probes
    if (scene.camera) {
        found.width = scene.camera->resolution[0];
        found.height = scene.camera->resolution[1];
        // Band by band: the largest picture's points need not fit into memory to be counted.
        for (int row = 0; row < found.height; row += 256) {
            GBuffer band = find_shading_points(scene, lit.lights(), lit.surfaces(), row,
                                               std::min(256, found.height - row), executor);
            lit.plan(band, executor);
            count_points(found, lit, band, sums);
            if (row <= found.height / 2) some = spread_tiles(band, most_tiles_of_savings);
        }
    } else {
        GBuffer probes = probe_points(scene, lit.lights(), lit.surfaces(), executor);
        lit.plan(probes, executor);
        count_points(found, lit, probes, sums);
        some = spread_tiles(probes, most_tiles_of_savings);
    }
    if (scene.camera && !scene.probes.empty()) {  // they call for effects, too
        GBuffer probes = probe_points(scene, lit.lights(), lit.surfaces(), executor);
        lit.plan(probes, executor);
        sums.add(lit.tiles_that_call(probes));
        found.tiles += probes.tiles.size();
    }
    found.probes = scene.probes.size();
    found.effects = explained(scene, lit.effects(), sums.of(found.tiles));
    measure_savings(lit, some, found.effects, stop);
    found.light_bytes = scene.lights.size() * sizeof(Light);
    found.hierarchy_bytes = lit.lights().bytes();
    return found;
}

}  // namespace mis
