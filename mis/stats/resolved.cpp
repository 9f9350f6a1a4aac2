#include "mis/stats/resolved.h"

#include "mis/stats/estimate.h"
#include "mis/stats/exactness.h"
#include "mis/stats/figures.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mis {
namespace {

/// float samples of one value differ by some ulp, so that their variance is some 1e-13 of the
/// squared mean.
constexpr double rounding_of_variances = 1e-6;

/// One figure, as the other strategies' samples have it and as a strategy's own have it.
struct Check {
    bool is_relative;
    double from_others, from_others_se, own, own_se;
    double zero;  ///< below this it is rounding

    double at_least() const { return from_others - audit_errors * from_others_se; }
    bool fails() const
    {
        return at_least() > std::max(audit_factor * (own + audit_errors * own_se), zero);
    }
    Reason reason() const { return reason::AuditFails{is_relative, at_least(), own}; }
};

/// A proof that its samples bear out: an estimate cannot refute it.
bool is_exact_by_proof(const StrategyMeasurements& s)
{
    return s.is_proved_exact && s.all_samples_equal_reference;
}

/// Where one figure's audit stands.
struct AuditedFigure {
    bool is_relative;
    bool Audit::*available;
    double Audit::*from_others, Audit::*from_others_se, Audit::*own, Audit::*own_se;
};
constexpr AuditedFigure audited_variance{false,
                                         &Audit::available,
                                         &Audit::variance_from_others,
                                         &Audit::variance_from_others_se,
                                         &Audit::own_variance,
                                         &Audit::own_variance_se};
constexpr AuditedFigure audited_relative_variance{true,
                                                  &Audit::relative_available,
                                                  &Audit::relative_variance_from_others,
                                                  &Audit::relative_variance_from_others_se,
                                                  &Audit::own_relative_variance,
                                                  &Audit::own_relative_variance_se};

/// What the audit has against a figure; nothing where it has nothing, or where there was none.
std::optional<Check> fault_of(const StrategyMeasurements& s, const AuditedFigure& figure)
{
    const Audit& a = s.audit;
    const double unit = figure.is_relative ? 1 : s.pooled.mean * s.pooled.mean;
    const Check check{figure.is_relative, a.*figure.from_others, a.*figure.from_others_se,
                      a.*figure.own,      a.*figure.own_se,      rounding_of_variances * unit};
    return a.*figure.available && check.fails() ? std::optional(check) : std::nullopt;
}

std::optional<Check> audit_fault(const StrategyMeasurements& s)
{
    if (is_exact_by_proof(s)) return std::nullopt;
    const std::optional<Check> fault = fault_of(s, audited_variance);
    return fault ? fault : fault_of(s, audited_relative_variance);
}

reason::Observations observations(const StrategyMeasurements& s)
{
    return {static_cast<double>(s.pooled.samples) / s.samples_per_observation,
            s.samples_per_observation > 1};
}

Reason carried_by_few(bool is_relative, const Participation& participation,
                      const StrategyMeasurements& s)
{
    return reason::CarriedByFew{is_relative, participation.number(), least_participation_to_rank,
                                observations(s)};
}

/// Do shared directions say what its variance is? An exact one's, its own samples do.
bool is_judged_by_shared(const StrategyMeasurements& s)
{
    return s.shared && !s.all_samples_equal_reference;
}

/// What is known of the logarithms of both variances by shared directions.
struct SharedErrors {
    LogEstimate variance, relative;
    double largest() const { return std::max(variance.se, relative.se); }
};
SharedErrors shared_errors(const SharedFigures& shared)
{
    return {log_contrast(shared.region_variances, {}), relative_log(shared)};
}

Reason why_shared_does_not_resolve(const StrategyMeasurements& s)
{
    const SharedFigures& shared = *s.shared;
    if (shared.region_variances.size() < 2) return reason::FewReplicates{};
    if (!std::isfinite(shared.variance) || !std::isfinite(s.pooled.mean))
        return reason::NotFinite{};
    const SharedErrors errors = shared_errors(shared);
    if (!is_above_errors(errors.variance) || !is_above_errors(errors.relative))
        return reason::BelowErrors{
            !std::isfinite(errors.variance.value) || is_above_errors(errors.variance), 3};
    if (!(errors.largest() <= largest_relative_error))
        return reason::ReplicatesDiffer{errors.largest(), largest_relative_error};
    return {};
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
    if (is_judged_by_shared(s)) {
        const double spread = shared_errors(*s.shared).largest() / largest_relative_error;
        return std::isfinite(spread) ? std::max(1.0, spread * spread) : 4;
    }
    double factor = audit_fault(s) ? 2 : 1;
    if (s.replicates.size() < 2 || s.pooled.variance <= 0) return 4;
    for (const Participation* p : {&s.pooled.participation, &s.pooled.relative_participation})
        if (p->sum_d4 > 0) factor = std::max(factor, least_participation_to_rank / p->number());
    const double spread = relative_error(s, &ReplicateValues::variance) / largest_relative_error;
    return std::isfinite(spread) ? std::max(factor, spread * spread) : std::max(factor, 4.0);
}

AuditedGrowth audited_growth(const StrategyMeasurements& s)
{
    if (is_judged_by_shared(s)) return {};
    const auto growth = [&s](const std::optional<Check>& fault) {
        return !is_exact_by_proof(s) && fault && fault->own > 0 ? fault->at_least() / fault->own
                                                                : 1;
    };
    return {growth(fault_of(s, audited_variance)), growth(fault_of(s, audited_relative_variance))};
}

Reason why_blind(const StrategyMeasurements& s)
{
    if (is_judged_by_shared(s)) return {};
    if (const auto fault = audit_fault(s)) return fault->reason();
    if (s.pooled.variance > 0 || s.all_samples_equal_reference) return {};
    return reason::NeverVaries{observations(s)};
}

namespace {

Reason why_not(const StrategyMeasurements& s, bool is_relative_asked)
{
    const PooledFigures& pooled = s.pooled;
    if (is_judged_by_shared(s)) return why_shared_does_not_resolve(s);
    if (const auto fault = audit_fault(s)) return fault->reason();
    if (s.all_samples_equal_reference) return {};
    if (s.replicates.size() < 2) return reason::FewReplicates{};
    if (!std::isfinite(pooled.variance) || !std::isfinite(pooled.mean)) return reason::NotFinite{};
    if (pooled.variance <= 0) return why_blind(s);
    if (is_within_rounding(pooled)) return reason::RoundingAlone{pooled.zero_points};
    if (pooled.participation.number() < least_participation_to_rank)
        return carried_by_few(false, pooled.participation, s);
    if (is_relative_asked && pooled.relative_participation.sum_d4 > 0 &&
        pooled.relative_participation.number() < least_participation_to_rank)
        return carried_by_few(true, pooled.relative_participation, s);
    const double error = relative_error(s, &ReplicateValues::variance);
    if (!(error <= largest_relative_error))
        return reason::ReplicatesDiffer{error, largest_relative_error};
    return {};
}

}  // namespace

bool is_refuted(const StrategyMeasurements& s) { return audit_fault(s).has_value(); }

Reason why_not_resolved(const StrategyMeasurements& s) { return why_not(s, true); }

Reason why_variance_not_resolved(const StrategyMeasurements& s) { return why_not(s, false); }

}  // namespace mis
