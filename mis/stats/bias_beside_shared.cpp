#include "mis/stats/bias.h"
#include "mis/stats/estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mis {
namespace {

/// Own mean less the right one, and the error of that.
LogEstimate difference_of(const MeanCheck& check)
{
    const double rounding = rounding_of_means * std::fabs(check.shared);
    const double known = std::hypot(check.own_se, rounding);
    const double se = std::hypot(known, check.shared_se);
    // Welch and Satterthwaite; the own error is from all points, with degrees of freedom without
    // number.
    const double share = se > 0 ? check.shared_se / se : 0;
    constexpr double most_dof = 1e6;
    const double dof =
        share > 0 ? std::min(most_dof, check.shared_dof / std::pow(share, 4)) : most_dof;
    return {check.own - check.shared, se, dof};
}

/// How many of its samples carry its variance there.
double carried_at(const StrategyMeasurements& s, std::size_t level)
{
    const Participation& carried =
        level == 0 ? s.pooled.participation : s.region_participation[level - 1];
    return carried.number();
}

/// Too high by a few samples that are as rare as they are bright is no bias.
bool is_testable(const StrategyMeasurements& s, std::size_t level, const LogEstimate& difference)
{
    const bool is_known = s.mean_checks[level].is_testable || s.all_samples_equal_reference;
    return is_known && difference.se > 0 &&
           (difference.value <= 0 || s.all_samples_equal_reference ||
            carried_at(s, level) >= least_region_participation);
}

BiasFinding finding_of(const StrategyMeasurements& s, double tests, double error)
{
    BiasFinding finding;
    for (std::size_t level = 0; level < s.mean_checks.size(); ++level) {
        const LogEstimate difference = difference_of(s.mean_checks[level]);
        if (!is_testable(s, level, difference)) continue;
        const double p = std::min(1.0, tests * two_sided_p(difference));
        if (p > finding.p_value) continue;
        finding.p_value = p;
        finding.why = {.region = static_cast<int>(level) - 1,
                       .regions = s.mean_checks.size() - 1,
                       .difference = difference.value,
                       .reference = s.mean_checks[level].shared,
                       .p_value = p,
                       .beside_shared = true};
    }
    finding.biased = finding.p_value < error;
    finding.too_low = finding.biased && finding.why.difference < 0;
    finding.only_in_regions = finding.biased && finding.why.region >= 0;
    return finding;
}

}  // namespace

std::vector<BiasFinding> find_bias_beside_shared(
    std::span<const StrategyMeasurements* const> strategies, double error)
{
    double tests = 0;
    for (const StrategyMeasurements* s : strategies)
        tests += static_cast<double>(s->mean_checks.size());
    std::vector<BiasFinding> findings;
    for (const StrategyMeasurements* s : strategies)
        findings.push_back(finding_of(*s, tests, error));
    return findings;
}

double least_detectable_bias(const StrategyMeasurements& s, double error, double tests)
{
    if (s.mean_checks.empty() || !(s.mean_checks.front().shared > 0))
        return std::numeric_limits<double>::quiet_NaN();
    const LogEstimate difference = difference_of(s.mean_checks.front());
    return (t_quantile(0.5 * error / tests, difference.dof) +
            t_quantile(interval_tail, difference.dof)) *
           difference.se / s.mean_checks.front().shared;
}

}  // namespace mis
