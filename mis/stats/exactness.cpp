#include "mis/stats/exactness.h"

#include "mis/strategy/names.h"

namespace mis {
namespace {

double squared(double x) { return x * x; }

/// Do the samples of every point agree with one another?
bool do_samples_agree(const PooledFigures& pooled, double over_all, double at_a_point)
{
    return pooled.single_points == 0 && pooled.relative_variance <= squared(over_all) &&
           pooled.largest_relative_variance <= squared(at_a_point);
}

bool was_looked_at_by_others(const StrategyMeasurements& s)
{
    return s.audit.available || draws_every_light(s.strategy.policy);
}

}  // namespace

Exactness exactness_of(const StrategyMeasurements& s)
{
    if (s.is_proved_exact)
        return do_samples_agree(s.pooled, rounding_of_proved_samples,
                                rounding_of_proved_samples * 1e3)
                   ? Exactness::by_proof
                   : Exactness::none;
    const bool is_by_samples =
        do_samples_agree(s.pooled, rounding_of_samples, rounding_of_a_point) &&
        s.pooled.zero_points == 0 && s.pooled.mean > 0 && was_looked_at_by_others(s);
    return is_by_samples ? Exactness::by_samples : Exactness::none;
}

bool is_within_rounding(const PooledFigures& pooled)
{
    return pooled.relative_variance <= squared(rounding_of_samples);
}

}  // namespace mis
