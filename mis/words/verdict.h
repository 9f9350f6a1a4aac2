#pragma once

#include "mis/report/report.h"

#include <string>
#include <vector>

namespace mis {

/// What a scene's report says, in words. First the verdict: which strategy to use here; how sure
/// that is; what it saves against the next best that is surely behind, and what is commonly used
/// (uniform/power, power/power, brdf); and where it draws more lights than one, which to use of the
/// others. Then which strategies are the same, ties, what is undecided, and why each strategy that
/// is not ranked is not.
/// threads, margin: of the report.
std::vector<std::string> sentences_of(const SceneReport& scene, int threads, double margin);

/// The same in two parts: the answer, and what stands behind it.
struct SceneWords {
    std::vector<std::string> answer, details;
};
SceneWords words_of(const SceneReport& scene, int threads, double margin);

/// The same over all scenes; empty unless there are several.
std::vector<std::string> overall_sentences_of(const Report& report);

}  // namespace mis
