#include "mis/cost/stopping.h"

namespace mis {
namespace {

constexpr std::uint64_t most_samples = std::uint64_t{1} << 24;
constexpr std::uint64_t most_samples_of_gain = 256;

}  // namespace

bool is_curve_done(const CostMeasurements& curve, std::uint64_t samples, double level_seconds,
                   double seconds_left, const CostGoal& goal, const ReferenceError& reference)
{
    if (goal.spp) return 2 * samples > *goal.spp;
    const bool fits = 2 * level_seconds <= 0.9 * seconds_left;
    const bool shows_gain = goal.is_sobol && samples < most_samples_of_gain;
    return !fits || 2 * samples > most_samples || (!shows_gain && tells_no_more(curve, reference));
}

}  // namespace mis
