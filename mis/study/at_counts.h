#pragma once

#include "mis/study/study.h"

#include <span>
#include <vector>

namespace mis {

/// A study at options.at, and every ranked strategy's figures where a point gets as many samples as
/// `further` lists. Independent samples have one variance; what depends on the count is run again
/// for each, when the ranking is done. Where time is the limit, the ranking and each further count
/// get the same share of it, and what one leaves goes to the next. Throws as run_study() does.
Study run_study_at(const LitScene& scene, const std::vector<Strategy>& strategies,
                   const StudyOptions& options, std::span<const double> further,
                   const AnyExecutor& executor);

}  // namespace mis
