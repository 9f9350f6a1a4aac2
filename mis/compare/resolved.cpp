#include "mis/compare/resolved.h"

#include "mis/compare/estimate.h"
#include "mis/compare/exactness.h"
#include "mis/compare/words.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mis {
namespace {

/// float samples of one value differ by some ulp, so that their variance is some 1e-13 of the
/// squared mean.
constexpr double rounding = 1e-6;

/// One figure, as the other strategies' samples have it and as a strategy's own have it.
struct Check {
    const char* what;
    double from_others, from_others_se, own, own_se;
    double zero;  ///< below this it is rounding

    double at_least() const { return from_others - audit_errors * from_others_se; }
    bool fails() const
    {
        return at_least() > std::max(audit_factor * (own + audit_errors * own_se), zero);
    }
    std::string in_words() const
    {
        return std::string("the other strategies' samples find a ") + what + " of at least " +
               number(at_least(), 2) + " where its own saw " + number(own, 2) +
               ": it has not drawn the rare samples that matter";
    }
};

/// A proof that its samples bear out: an estimate cannot refute it.
bool is_exact_by_proof(const StrategyMeasurements& s)
{
    return s.is_proved_exact && s.all_samples_equal_reference;
}

/// What the audit has against its variance, or its relative variance; nothing where it has nothing,
/// or where there was none.
std::optional<Check> variance_fault(const StrategyMeasurements& s)
{
    const Audit& a = s.audit;
    const Check check{
        "variance",     a.variance_from_others, a.variance_from_others_se,
        a.own_variance, a.own_variance_se,      rounding * s.pooled.mean * s.pooled.mean};
    return a.available && check.fails() ? std::optional(check) : std::nullopt;
}
std::optional<Check> relative_fault(const StrategyMeasurements& s)
{
    const Audit& a = s.audit;
    const Check check{"relative variance",
                      a.relative_variance_from_others,
                      a.relative_variance_from_others_se,
                      a.own_relative_variance,
                      a.own_relative_variance_se,
                      rounding};
    return a.relative_available && check.fails() ? std::optional(check) : std::nullopt;
}
std::optional<Check> audit_fault(const StrategyMeasurements& s)
{
    if (is_exact_by_proof(s)) return std::nullopt;
    const std::optional<Check> fault = variance_fault(s);
    return fault ? fault : relative_fault(s);
}

/// "4096 samples", or "256 scramblings".
std::string observations_in_words(const StrategyMeasurements& s)
{
    const double observations = static_cast<double>(s.pooled.samples) / s.samples_per_observation;
    return count(observations) + (s.samples_per_observation > 1 ? " scramblings" : " samples");
}

std::string carried_by_few(const Participation& participation, const StrategyMeasurements& s,
                           const char* what)
{
    return std::string("its ") + what + " is carried by about " + count(participation.number()) +
           " of " + observations_in_words(s) + "; " + count(least_participation_to_rank) +
           " are needed" +
           (participation.number() > 0
                ? ", about " +
                      number(std::max(1.1, least_participation_to_rank / participation.number()),
                             2) +
                      " times as many samples as now"
                : "");
}

/// Relative standard error of one of the replicates' figures.
double relative_error(const StrategyMeasurements& s, double ReplicateValues::*figure)
{
    std::vector<double> values;
    for (const ReplicateValues& replicate : s.replicates) values.push_back(replicate.*figure);
    return log_mean(values).se;
}

}  // namespace

double resolving_factor(const StrategyMeasurements& s)
{
    double factor = audit_fault(s) ? 2 : 1;
    if (s.replicates.size() < 2 || s.pooled.variance <= 0) return 4;
    for (const Participation* p : {&s.pooled.participation, &s.pooled.relative_participation})
        if (p->sum_d4 > 0) factor = std::max(factor, least_participation_to_rank / p->number());
    const double spread = relative_error(s, &ReplicateValues::variance) / largest_relative_error;
    return std::isfinite(spread) ? std::max(factor, spread * spread) : std::max(factor, 4.0);
}

AuditedGrowth audited_growth(const StrategyMeasurements& s)
{
    const auto growth = [&s](const std::optional<Check>& fault) {
        return !is_exact_by_proof(s) && fault && fault->own > 0 ? fault->at_least() / fault->own
                                                                : 1;
    };
    return {growth(variance_fault(s)), growth(relative_fault(s))};
}

std::string why_blind(const StrategyMeasurements& s)
{
    if (const auto fault = audit_fault(s)) return fault->in_words();
    if (s.pooled.variance > 0 || s.all_samples_equal_reference) return "";
    return "all of its " + observations_in_words(s) +
           " say the same, which proves nothing: rare samples may not have been drawn yet";
}

namespace {

/// Where its samples differ by rounding alone, and it is not exact for all that.
std::string why_not_exact(const StrategyMeasurements& s)
{
    const std::string found = "its samples differ by the rounding of floats alone, ";
    if (s.pooled.zero_points > 0)
        return found + "but at " + count(static_cast<double>(s.pooled.zero_points)) +
               (s.pooled.zero_points == 1 ? " point" : " points") +
               " all of them are 0, which proves nothing: rare samples may not have been "
               "drawn yet";
    return found + "which shows no variance and does not prove that there is none";
}

std::string why_not(const StrategyMeasurements& s, bool is_relative_asked)
{
    const PooledFigures& pooled = s.pooled;
    if (const auto fault = audit_fault(s)) return fault->in_words();
    if (s.all_samples_equal_reference) return "";
    if (s.replicates.size() < 2) return "its error takes at least two replicates";
    if (!std::isfinite(pooled.variance) || !std::isfinite(pooled.mean))
        return "its variance is not a finite number";
    if (pooled.variance <= 0) return why_blind(s);
    if (is_within_rounding(pooled)) return why_not_exact(s);
    if (pooled.participation.number() < least_participation_to_rank)
        return carried_by_few(pooled.participation, s, "variance");
    if (is_relative_asked && pooled.relative_participation.sum_d4 > 0 &&
        pooled.relative_participation.number() < least_participation_to_rank)
        return carried_by_few(pooled.relative_participation, s, "relative variance");
    const double error = relative_error(s, &ReplicateValues::variance);
    if (!(error <= largest_relative_error))
        return "its variance differs too much from replicate to replicate (its standard error is " +
               (std::isnan(error) ? "unknown" : percent(error)) + "; at most " +
               percent(largest_relative_error) + " is trusted)";
    return "";
}

}  // namespace

std::string why_not_resolved(const StrategyMeasurements& s) { return why_not(s, true); }

std::string why_variance_not_resolved(const StrategyMeasurements& s) { return why_not(s, false); }

}  // namespace mis
