#pragma once

#include "mis/study/strategy_run.h"

#include "mis/math/stop_token.h"

namespace mis {

/// What all that samples a scene needs: where, with what, how, and until when:
/// what is worth nothing before it is done throws Stopped.
struct StudyGround {
    const LitScene& scene;
    const StudyPoints& points;
    WorkspacePool<float>& workspaces;
    const AnyExecutor& executor;
    std::uint64_t seed = 1;
    StopToken stop = {};

    bool is_stopped() const { return stop.is_up(); }
};

/// 1/(μ² + ε²) of every point, from a rough picture; 0 where that is black. Its samples count for
/// nothing else, so no figure is biased by it.
std::vector<double> rough_weights(const StudyGround& ground);

/// How many times the mean number of samples each tile should get so that the variances of all of
/// these strategies come out most exact: in proportion to √(Σ μ4/V² per point), between half and
/// 32 times (stratified sampling, Neyman 1934; docs/theory.md). From samples that count for
/// nothing else.
std::vector<double> best_tile_factors(const StudyGround& ground,
                                      std::span<const Strategy> strategies);

}  // namespace mis
