#include "mis/compare/resolved.h"

#include "mis/compare/estimate.h"
#include "mis/compare/words.h"

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

/// float samples of one value differ by some ulp, so that their variance is some 1e-13 of the
/// squared mean.
constexpr double rounding = 1e-6;

bool audit_fails(const StrategyMeasurements& s)
{
    const Audit& audit = s.audit;
    if (!audit.available) return false;
    const double at_least =
        audit.variance_from_others - audit_errors * audit.variance_from_others_se;
    const double at_most = audit.own_variance + audit_errors * audit.own_variance_se;
    return at_least > std::max(audit_factor * at_most, rounding * s.pooled.mean * s.pooled.mean);
}

std::string carried_by_few(const Participation& participation, std::uint64_t samples,
                           const char* what)
{
    return std::string("its ") + what + " is carried by about " + count(participation.number()) +
           " of " + count(static_cast<double>(samples)) + " samples; " +
           count(least_participation) + " are needed";
}

/// Relative standard error of one of the replicates' figures.
double relative_error(const StrategyMeasurements& s, double ReplicateValues::*figure)
{
    std::vector<double> values;
    for (const ReplicateValues& replicate : s.replicates) values.push_back(replicate.*figure);
    return log_mean(values).se;
}

}  // namespace

std::string why_not_resolved(const StrategyMeasurements& s)
{
    const PooledFigures& pooled = s.pooled;
    if (audit_fails(s))
        return "the other strategies' samples find a variance of at least " +
               number(s.audit.variance_from_others - audit_errors * s.audit.variance_from_others_se,
                      2) +
               " where its own saw " + number(s.audit.own_variance, 2) +
               ": it has not drawn the rare samples that matter";
    if (s.all_samples_equal_reference) return "";
    if (s.replicates.size() < 2) return "its error takes at least two replicates";
    if (!std::isfinite(pooled.variance) || !std::isfinite(pooled.mean))
        return "its variance is not a finite number";
    if (pooled.variance <= 0)
        return "all of its " + count(static_cast<double>(pooled.samples)) +
               " samples say the same, which proves nothing: rare samples may not have been drawn "
               "yet";
    if (pooled.participation.number() < least_participation)
        return carried_by_few(pooled.participation, pooled.samples, "variance");
    if (pooled.relative_participation.sum_d4 > 0 &&
        pooled.relative_participation.number() < least_participation)
        return carried_by_few(pooled.relative_participation, pooled.samples, "relative variance");
    const double error = relative_error(s, &ReplicateValues::variance);
    if (!(error <= largest_relative_error))
        return "its variance differs too much from replicate to replicate (its standard error is " +
               (std::isnan(error) ? "unknown" : percent(error)) + "; at most " +
               percent(largest_relative_error) + " is trusted)";
    return "";
}

}  // namespace mis
