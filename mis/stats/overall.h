#pragma once

#include "mis/report/report.h"

#include <vector>

namespace mis {

/// Ranks the strategies over several scenes: by the geometric mean, over the scenes, of a
/// strategy's variance over the least of that scene; likewise of variance × time, and of the time
/// to 1 % error. Every scene counts alike, however bright it is. Only strategies that are ranked on
/// all scenes take part. Where others are exact on a scene and it is not, the ratio would be
/// infinite: such scenes are counted (beaten_by_exact) and decide first, and the ratio is over the
/// best of those that are not exact there. The intervals come from those of the scenes' pairs,
/// independent of one another. By rank; empty for fewer than two scenes.
std::vector<OverallReport> rank_overall(const std::vector<SceneReport>& scenes);

}  // namespace mis
