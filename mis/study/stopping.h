#pragma once

#include "mis/report/report.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace mis {

/// How long a study was asked to go on. None of the three: until it is settled (decided, and every
/// ranked variance known to ± 25 %), or default_seconds.
struct StudyGoal {
    std::optional<std::uint64_t> spp;  ///< so many samples per point, for every strategy
    std::optional<double> seconds;     ///< so much wall time
    std::optional<double> error;       ///< until every ranked variance is known to ± this share
    double default_seconds = 30;

    /// Wall seconds that it may take; all but endless where an error is asked for.
    double budget() const { return seconds.value_or(error ? 1e7 : default_seconds); }
    bool stops_when_settled() const { return !spp && !seconds && !error; }
};

// Pure functions of what was measured so far and of the time that has passed, in wall seconds.

/// Is what was asked for reached? Nothing is, while a strategy may yet be resolved in time.
bool is_enough(const SceneReport& so_far, const StudyGoal& goal, double elapsed);

/// Which strategies the next rounds are not for. They are for those that may be best, until it is
/// decided; for those whose variance is not known to ± 25 %; for those that may yet be resolved in
/// time. Where there is none of these, they are for all.
std::vector<bool> resting(const SceneReport& so_far, const StudyGoal& goal, double elapsed);

}  // namespace mis
