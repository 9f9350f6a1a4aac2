#pragma once

#include "mis/effects/tile_plan.h"
#include "mis/run/executor.h"
#include "mis/scene/point_counts.h"
#include "mis/scene/scene.h"
#include "mis/scene/shading_point.h"
#include "mis/trace/lights.h"
#include "mis/trace/visibility.h"

#include <cstdint>
#include <vector>

namespace mis {

/// Neighbouring shading points of one material.
struct Tile {
    std::uint32_t first = 0, count = 0;  ///< of GBuffer::points
    int material = 0;
    Vec3<double> origin{0};  ///< near its points
    TilePlan plan = {};      ///< what is proved of it: plan_tiles()
};

/// A pixel that shows no surface.
struct Background {
    std::uint32_t pixel;
    LightIndex light;  ///< that the camera sees there, or no_light
};

/// The shading points of a scene, found once and kept, cut into tiles. Random numbers go by a
/// point's id: its pixel's number, or after all pixels the probe's.
struct GBuffer {
    int width = 0, height = 0;         ///< of the camera's picture; 0 without a camera
    int first_row = 0, rows = 0;       ///< the band of the picture that was found
    std::vector<ShadingPoint> points;  ///< in the order of the tiles
    std::vector<Tile> tiles;           ///< points that can be lit
    std::vector<std::uint32_t> dark;   ///< ids of points that see no light: inside one, seen from
                                       ///< below, or above all of them
    std::vector<Background> background;
    PointCounts counts = {};
};

/// Points per tile at most: a square of pixels.
inline constexpr int tile_side = 16;

/// The shading points of the camera's rows [first_row, first_row + rows), through the pixels'
/// centres. surfaces: nullptr where the scene has none.
GBuffer find_shading_points(const Scene& scene, const LightHierarchy& lights,
                            const SurfaceTracer* surfaces, int first_row, int rows,
                            const AnyExecutor& executor);

/// Finds out what each tile calls for, and leaves it there.
void plan_tiles(GBuffer& buffer, const TilePlanner& planner, const AnyExecutor& executor);

/// The probes, each a tile of its own.
GBuffer probe_points(const Scene& scene, const LightHierarchy& lights,
                     const SurfaceTracer* surfaces, const AnyExecutor& executor);

}  // namespace mis
