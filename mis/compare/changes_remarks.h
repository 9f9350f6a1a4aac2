#pragma once

#include "mis/compare/report.h"

#include <string>
#include <vector>

namespace mis {

/// How two runs differ, in sentences: version, seed, machine, threads …, and what that means for a
/// comparison. Empty where they do not.
std::vector<std::string> remarks_on(const Report& before, const Report& after);

/// The same of a scene that both looked at: file, contents, points, samples.
std::vector<std::string> remarks_on(const SceneReport& before, const SceneReport& after);

/// Are both reports' figures of the same points of the same scene, as far as they tell?
bool same_points(const SceneReport& before, const SceneReport& after);

}  // namespace mis
