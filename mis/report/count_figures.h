#pragma once

#include "mis/report/field.h"
#include "mis/report/interval.h"
#include "mis/report/reason.h"

#include <array>
#include <limits>

namespace mis {

/// design §1, Figures: a strategy is in one state, tested in this order.
enum class Status { not_run, not_resolved, biased, ranked };

constexpr std::array<const char*, 4> names_of(Status)
{
    return {"not_run", "not_resolved", "biased", "ranked"};
}

/// One strategy's figures where a point gets n samples. The variance is V_n: n times the variance
/// of the mean of n.
struct CountFigures {
    double n = 0;
    Status status = Status::not_run;  ///< of its run with n samples per observation
    Reason reason;                    ///< for every status but ranked
    Interval variance, relative_variance;
    Interval seconds_per_sample;  ///< CPU time, with a sample's part of the point's preparation
    Interval efficiency;          ///< 1/(variance · those seconds); infinite where exact
    Interval relative_error;      ///< of a picture of n samples: √(relative variance / n)
    /// CPU time that its first samples would take; NaN unless not_run.
    double estimated_seconds = std::numeric_limits<double>::quiet_NaN();
};

template <class Visitor, Either<CountFigures> S> void describe(Visitor& v, S& c)
{
    v.number(Field("n"), c.n);
    v.one_of(Field("status"), c.status, names_of(c.status));
    v.reason(Field("reason"), c.reason);
    v.interval(Field("variance", unit::luminance2), c.variance);
    v.interval(Field("relative_variance"), c.relative_variance);
    v.interval(Field("seconds_per_sample", unit::cpu_seconds), c.seconds_per_sample);
    v.interval(Field("efficiency", unit::per_luminance2_second), c.efficiency);
    v.interval(Field("relative_error"), c.relative_error);
    v.size(Field("estimated_seconds", unit::cpu_seconds), c.estimated_seconds);
}

}  // namespace mis
