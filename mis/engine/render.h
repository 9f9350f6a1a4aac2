#pragma once

#include "mis/engine/lit_scene.h"
#include "mis/math/stop_token.h"

#include <functional>
#include <vector>

namespace mis {

/// A picture: linear RGB radiance, row by row from the top.
struct Image {
    int width = 0, height = 0;
    std::vector<Vec3<float>> pixels;
};

/// What one strategy made of some rows of a picture.
struct Band {
    GBuffer shading;
    std::vector<PointResult> results;  ///< one per shading point
    int samples_per_observation = 1;   ///< of the results
};

/// The shading points of a picture's rows, unlit.
Band find_band(const LitScene& scene, int first_row, int rows, const AnyExecutor& executor);

/// Adds samples [first, first + count) to every shading point, whole observations of the strategy;
/// once `stop` is up, to some alone (least_samples). Returns what it cost.
TileTotals light_band(const ReadyStrategy<float>& strategy, Band& band, std::uint64_t first,
                      int count, WorkspacePool<float>& workspaces, const AnyExecutor& executor,
                      const StopToken& stop = {});

/// How many samples every shading point of the band has, at least.
std::uint64_t least_samples(const Band& band);

/// The band's pixels into the image: means at shading points, lights that the camera sees, black
/// elsewhere.
void draw_band(const LitScene& scene, const Band& band, Image& image);

}  // namespace mis
