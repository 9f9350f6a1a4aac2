#pragma once

#include "mis/engine/gbuffer.h"
#include "mis/engine/lit_scene.h"
#include "mis/stats/pool.h"

#include <cstdint>
#include <vector>

namespace mis {

/// The shading points of a study: those that its figures are over, then probes that are listed
/// apart.
struct StudyPoints {
    GBuffer shading;                        ///< all of them, in tiles
    std::size_t figure_tiles = 0;           ///< the first tiles, that the figures are over
    std::size_t figure_lit = 0;             ///< points in those tiles
    std::size_t figure_points = 0;          ///< with the dark ones
    std::vector<std::int64_t> probe_point;  ///< [probe]: its point, or −1 where it is dark
    std::size_t regions = 0;                ///< of the image, for the bias test
    bool has_camera = false;                ///< else the figures are over probes

    std::size_t region_of(std::size_t tile) const { return tile * regions / figure_tiles; }
    int material_of(std::size_t point) const;
    FigurePoints figures() const { return {figure_lit, figure_points, has_camera}; }
};

/// Camera and probes; the figures are over the camera's points, or without a camera over the probes
/// (design §2).
StudyPoints find_study_points(const LitScene& scene, const AnyExecutor& executor);

/// At most `most` of the figures' points, evenly spread.
std::vector<std::size_t> spread_points(const StudyPoints& points, std::size_t most);

}  // namespace mis
