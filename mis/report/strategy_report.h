#pragma once

#include "mis/report/count_figures.h"
#include "mis/report/field.h"
#include "mis/report/interval.h"
#include "mis/report/reason.h"
#include "mis/report/strategy_fields.h"
#include "mis/sampling/sample_name.h"
#include "mis/strategy/strategy.h"

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mis {

/// What a variance is measured by: a strategy's own samples, or directions that all strategies
/// share (docs/theory.md §25).
enum class VarianceSource { own, shared };

constexpr std::array<const char*, 2> names_of(VarianceSource) { return {"own", "shared"}; }

/// One shading point's (a probe's) figures.
struct PointFigures {
    double mean = 0, mean_se = 0;  ///< luminance
    Interval variance;             ///< of one sample, luminance²
};

template <class Visitor, Either<PointFigures> S> void describe(Visitor& v, S& point)
{
    v.figure(Field("mean", unit::luminance), point.mean);
    v.size(Field("mean_se", unit::luminance), point.mean_se);
    v.interval(Field("variance", unit::luminance2), point.variance);
}

template <class Visitor, Either<SampleName> S> void describe(Visitor& v, S& name)
{
    v.count(Field("point"), name.point);
    v.count(Field("sample"), name.sample);
}

/// How many times what a strategy's own samples show its variances are, at least
/// (stats/resolved.h).
struct AuditedGrowth {
    double variance = 1, relative_variance = 1;
};

template <class Visitor, Either<AuditedGrowth> S> void describe(Visitor& v, S& growth)
{
    v.size(Field("variance"), growth.variance);
    v.size(Field("relative_variance"), growth.relative_variance);
}

/// All that was found about one strategy on one scene.
struct StrategyReport {
    Strategy strategy;
    Status status = Status::not_run;
    Reason reason;                              ///< for every status but ranked
    bool exact = false;                         ///< zero variance, proved
    int rank = 0, rank_low = 0, rank_high = 0;  ///< by variance; 0 where not ranked
    int rank_by_efficiency = 0, rank_by_efficiency_low = 0, rank_by_efficiency_high = 0;
    std::vector<std::string> tied_with;  ///< names, by variance
    /// By time to 1 %, or without times by variance (stats/decision.h); for all strategies
    /// together.
    bool may_be_best = false;
    /// The share by which it may be behind the best at most; NaN where nothing is known.
    double behind_at_most = std::numeric_limits<double>::quiet_NaN();
    std::uint64_t samples = 0;     ///< of its own, over all shading points
    double mean = 0, mean_se = 0;  ///< luminance, over the shading points
    VarianceSource variance_from = VarianceSource::own;
    Interval variance;                            ///< of one sample (docs/theory.md (70) where
                                                  ///< is_sobol); mean over the shading points
    Interval relative_variance;                   ///< design §1
    int timed_rounds = 0;                         ///< that the times come from
    Interval seconds_per_point;                   ///< CPU time to prepare one shading point
    Interval seconds_per_sample;                  ///< CPU time
    std::map<std::string, double> stage_seconds;  ///< per sample
    double rays_per_sample = 0;
    Interval efficiency;            ///< 1/(luminance²·s); infinite where exact
    Interval seconds_to_1_percent;  ///< wall time on the stated threads
    /// CPU time that it would take; NaN unless not_run.
    double estimated_seconds = std::numeric_limits<double>::quiet_NaN();
    /// The least bias of its mean, relative to that, that would all but surely have been found; NaN
    /// where no shared directions tell the right mean.
    double least_detectable_bias = std::numeric_limits<double>::quiet_NaN();
    double bias_p_value = 1;      ///< against the reference pooled from the others, corrected
    double rare_share = 0;        ///< share of the variance at points where rare samples carry it
                                  ///< (stats/pool.h)
    double resolving_factor = 1;  ///< about how many times as many samples would resolve it; 1
                                  ///< where it is, NaN where it is not known
    AuditedGrowth least_growth;
    /// How many samples carry the variance: about 1 over its squared relative standard error. Of
    /// own samples by their participation (stats/measurements.h), of shared directions by that
    /// error.
    double effective_samples = 0;
    std::uint64_t invalid_samples = 0;
    std::optional<SampleName> first_invalid;  ///< where there are any, and it is known
    std::vector<PointFigures> probes;
    /// Where a point gets n samples, for every n asked for; empty unless ranked.
    std::vector<CountFigures> at_counts;
};

template <class Visitor, Either<StrategyReport> S> void describe(Visitor& v, S& s)
{
    describe(v, s.strategy);
    v.one_of(Field("status"), s.status, names_of(s.status));
    v.reason(Field("reason"), s.reason);
    v.flag(Field("exact"), s.exact);
    v.place(Field("rank"), s.rank);
    v.place(Field("rank_low"), s.rank_low);
    v.place(Field("rank_high"), s.rank_high);
    v.names(Field("tied_with"), s.tied_with);
    v.flag(Field("may_be_best").later(), s.may_be_best);
    v.size(Field("behind_at_most").later(), s.behind_at_most);
    v.place(Field("rank_by_efficiency"), s.rank_by_efficiency);
    v.place(Field("rank_by_efficiency_low"), s.rank_by_efficiency_low);
    v.place(Field("rank_by_efficiency_high"), s.rank_by_efficiency_high);
    v.count(Field("samples"), s.samples);
    v.figure(Field("mean", unit::luminance), s.mean);
    v.size(Field("mean_se", unit::luminance), s.mean_se);
    v.size(Field("bias_p_value"), s.bias_p_value);
    v.size(Field("least_detectable_bias").later(), s.least_detectable_bias);
    v.one_of(Field("variance_from").later(), s.variance_from, names_of(s.variance_from));
    v.interval(Field("variance", unit::luminance2), s.variance);
    v.interval(Field("relative_variance"), s.relative_variance);
    v.size(Field("rare_share"), s.rare_share);
    v.size(Field("effective_samples"), s.effective_samples);
    v.size(Field("resolving_factor").outside_table().later(), s.resolving_factor);
    v.object(Field("least_growth").outside_table().later(), s.least_growth);
    v.count(Field("timed_rounds").outside_table().later(), s.timed_rounds);
    v.interval(Field("seconds_per_point", unit::cpu_seconds), s.seconds_per_point);
    v.interval(Field("seconds_per_sample", unit::cpu_seconds), s.seconds_per_sample);
    v.sizes(Field("stage_seconds", unit::cpu_seconds).outside_table(), s.stage_seconds);
    v.size(Field("rays_per_sample"), s.rays_per_sample);
    v.interval(Field("efficiency", unit::per_luminance2_second), s.efficiency);
    v.value_and_interval(Field("seconds_to_1_percent", unit::wall_seconds), s.seconds_to_1_percent);
    v.size(Field("estimated_seconds", unit::cpu_seconds), s.estimated_seconds);
    v.count(Field("invalid_samples"), s.invalid_samples);
    v.maybe(Field("first_invalid").outside_table().later(), s.first_invalid);
    v.list(Field("probes").outside_table(), s.probes);
    v.list(Field("at_counts").outside_table().later(), s.at_counts);
}

/// How two strategies stand: a's figure over b's. The verdicts of one kind hold for all pairs
/// together (95 %), the intervals for each pair alone.
enum class Verdict { apart, tied, undecided };

constexpr std::array<const char*, 3> names_of(Verdict) { return {"apart", "tied", "undecided"}; }

/// The strategies of a scene by name, and their names.
class StrategyIndex {
public:
    explicit StrategyIndex(const std::vector<StrategyReport>& strategies)
    {
        for (const StrategyReport& s : strategies) {
            names_.push_back(name_of(s.strategy));
            by_name_.emplace(names_.back(), static_cast<int>(names_.size()) - 1);
        }
    }
    const std::string& name(int i) const { return names_[static_cast<std::size_t>(i)]; }
    /// Nothing where no strategy is called so.
    std::optional<int> find(const std::string& name) const
    {
        const auto found = by_name_.find(name);
        return found == by_name_.end() ? std::nullopt : std::optional(found->second);
    }

private:
    std::vector<std::string> names_;
    std::map<std::string, int> by_name_;
};

struct PairReport {
    int a = 0, b = 0;  ///< indices into SceneReport::strategies; a has the lower variance
    Interval ratio;    ///< of the variances; 0 where a alone is exact
    Verdict verdict = Verdict::undecided;
    double more_replicates = 0;  ///< about how many more would decide it; for undecided
    Interval efficiency_ratio;   ///< of the efficiencies; infinite where a alone is
                                 ///< exact
    Verdict efficiency_verdict = Verdict::undecided;
    Interval time_ratio;  ///< of the times to 1 %: how many times sooner b reaches it
    Verdict time_verdict = Verdict::undecided;
};

/// strategies: of the scene.
template <class Visitor, Either<PairReport> S>
void describe(Visitor& v, S& p, const StrategyIndex& strategies)
{
    v.index(Field("a"), p.a, strategies);
    v.index(Field("b"), p.b, strategies);
    v.interval(Field("variance_ratio"), p.ratio);
    v.one_of(Field("verdict"), p.verdict, names_of(p.verdict));
    v.size(Field("more_replicates"), p.more_replicates);
    v.interval(Field("efficiency_ratio"), p.efficiency_ratio);
    v.one_of(Field("efficiency_verdict"), p.efficiency_verdict, names_of(p.verdict));
    v.interval(Field("time_ratio"), p.time_ratio);
    v.one_of(Field("time_verdict"), p.time_verdict, names_of(p.verdict));
}

}  // namespace mis
