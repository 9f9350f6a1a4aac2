#include "mis/study/study_points.h"

#include <algorithm>
#include <iterator>

namespace mis {

namespace {

void append(GBuffer& all, const GBuffer& more)
{
    for (Tile tile : more.tiles) {
        tile.first += static_cast<std::uint32_t>(all.points.size());
        all.tiles.push_back(tile);
    }
    all.points.insert(all.points.end(), more.points.begin(), more.points.end());
}

}  // namespace

int StudyPoints::material_of(std::size_t point) const
{
    const std::vector<Tile>& tiles = shading.tiles;
    const auto after =
        std::upper_bound(tiles.begin(), tiles.end(), point,
                         [](std::size_t p, const Tile& tile) { return p < tile.first; });
    return std::prev(after)->material;
}

StudyPoints find_study_points(const LitScene& scene, const AnyExecutor& executor)
{
    StudyPoints points;
    const std::optional<Camera>& camera = scene.scene().camera;
    points.has_camera = camera.has_value();
    if (camera)
        points.shading = find_shading_points(scene.scene(), scene.lights(), scene.surfaces(), 0,
                                             camera->resolution[1], executor);
    const GBuffer probes = probe_points(scene.scene(), scene.lights(), scene.surfaces(), executor);
    points.figure_points = camera ? points.shading.points.size() + points.shading.dark.size()
                                  : scene.scene().probes.size();
    points.figure_tiles = camera ? points.shading.tiles.size() : probes.tiles.size();
    points.figure_lit = camera ? points.shading.points.size() : probes.points.size();

    const std::size_t first_probe_point = points.shading.points.size();
    const std::uint32_t pixels = camera ? static_cast<std::uint32_t>(camera->resolution[0]) *
                                              static_cast<std::uint32_t>(camera->resolution[1])
                                        : 0;
    points.probe_point.assign(scene.scene().probes.size(), -1);
    for (std::size_t p = 0; p < probes.points.size(); ++p)
        points.probe_point[probes.points[p].id - pixels] =
            static_cast<std::int64_t>(first_probe_point + p);
    append(points.shading, probes);
    scene.plan(points.shading, executor);
    points.regions = std::min<std::size_t>(64, points.figure_tiles);
    return points;
}

std::vector<std::size_t> spread_points(const StudyPoints& points, std::size_t most)
{
    std::vector<std::size_t> chosen;
    const std::size_t count = std::min(most, points.figure_lit);
    for (std::size_t i = 0; i < count; ++i) chosen.push_back(i * points.figure_lit / count);
    return chosen;
}

}  // namespace mis
