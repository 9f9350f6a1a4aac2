#pragma once

#include "mis/study/shared_turns.h"
#include "mis/study/strategy_run.h"

#include <optional>
#include <vector>

namespace mis {

/// The means of a strategy's own samples beside those of shared directions: of the image, then of
/// each region. Their errors are by the variance that shared directions find, so that rare samples
/// which were never drawn do not make them look sure. place: of the strategy among those that
/// share; where it is none of them, errors are by its own samples, and nothing is
/// tested: rare directions that the shared mean lacks would be called its bias. Precondition:
/// shared.is_known().
std::vector<MeanCheck> mean_checks(const StrategyRun& run, const StudyPoints& points,
                                   const SharedTurns& shared, std::optional<std::size_t> place);

}  // namespace mis
