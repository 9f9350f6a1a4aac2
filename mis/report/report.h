#pragma once

#include "mis/effects/effects.h"
#include "mis/report/run_head.h"
#include "mis/report/scene_facts.h"
#include "mis/report/setup_seconds.h"
#include "mis/report/strategy_report.h"

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mis {

template <class Visitor, Either<EffectPlan> S> void describe(Visitor& v, S& effect)
{
    v.flag(Field("on"), effect.on);
    v.size(Field("share"), effect.share);
    v.text(Field("why"), effect.why);
    v.figure(Field("saved_rays_per_sample"), effect.saved_rays_per_sample);
    v.figure(Field("saved_seconds_per_sample", unit::cpu_seconds), effect.saved_seconds_per_sample);
}

struct SceneReport : SceneFacts {
    int replicates = 0;
    std::uint64_t directions = 0;  ///< per point, that all strategies share; 0: none
    double epsilon = 0;            ///< of the relative variance
    bool decided = false;          ///< the leader is at most `most_behind` behind every other
    std::string leader;            ///< the strategy to use; empty where none is ranked
    /// The same among those that draw one light per sample, or none.
    bool decided_of_one_light = false;
    std::string leader_of_one_light;
    /// Wall seconds more that would decide, about; 0 if it is decided, NaN where that is not known.
    double seconds_to_decide = std::numeric_limits<double>::quiet_NaN();
    bool settled = false;  ///< decided, and every ranked variance is known to ± 25 %
    bool partial = false;
    bool lacks_audit = false;            ///< for rare samples that were never drawn
    bool had_no_time_for_audit = false;  ///< that is why; else that its samples are sequences
    double seconds = 0;                  ///< wall
    std::optional<SetupSeconds> setup;   ///< where it was timed
    std::vector<EffectPlan> effects;
    std::vector<StrategyReport> strategies;  ///< in the order asked for
    std::vector<PairReport> pairs;           ///< of ranked strategies
};

/// run: the report that it stands in. Reports that say nothing of audits are taken at their
/// sampler: sequences are not audited.
template <class Visitor, Either<SceneReport> S, class Run>
void describe(Visitor& v, S& scene, const Run& run)
{
    describe_facts(v, scene);
    v.count(Field("replicates"), scene.replicates);
    v.count(Field("directions").later(), scene.directions);
    v.size(Field("epsilon", unit::luminance), scene.epsilon);
    v.flag(Field("decided").later(), scene.decided);
    v.text_or_null(Field("leader").later(), scene.leader);
    v.flag(Field("decided_of_one_light").later(), scene.decided_of_one_light);
    v.text_or_null(Field("leader_of_one_light").later(), scene.leader_of_one_light);
    v.size(Field("seconds_to_decide", unit::wall_seconds).later(), scene.seconds_to_decide);
    v.flag(Field("settled"), scene.settled);
    v.flag(Field("lacks_audit").later(), scene.lacks_audit, run.is_sobol);
    v.flag(Field("had_no_time_for_audit").later(), scene.had_no_time_for_audit);
    v.flag(Field("partial"), scene.partial);
    v.size(Field("seconds", unit::wall_seconds), scene.seconds);
    v.maybe(Field("setup_seconds").later(), scene.setup);
    v.by_name(Field("effects"), scene.effects);
    v.unique(Field("strategies"), scene.strategies);
    v.list(Field("pairs"), scene.pairs, StrategyIndex(scene.strategies));
    v.sentences(Field("sentences"), scene, run);
}

/// One strategy over all scenes (stats/overall.h): geometric means of its figures over the best
/// one's of each scene.
struct OverallReport {
    std::string name;
    int rank = 0, rank_by_efficiency = 0;
    Interval variance_ratio, cost_ratio,
        time_ratio;           ///< ≥ 1; cost: variance × time, 1/efficiency; time: to 1 %
    int beaten_by_exact = 0;  ///< scenes on which others are exact and it is not; there the first
                              ///< two are over the best inexact
};

template <class Visitor, Either<OverallReport> S> void describe(Visitor& v, S& o)
{
    v.text(Field("name"), o.name);
    v.place(Field("rank"), o.rank);
    v.place(Field("rank_by_efficiency"), o.rank_by_efficiency);
    v.interval(Field("variance_ratio"), o.variance_ratio);
    v.interval(Field("cost_ratio"), o.cost_ratio);
    v.interval(Field("time_ratio"), o.time_ratio);
    v.count(Field("beaten_by_exact"), o.beaten_by_exact);
}

/// What the key "format" of a report says.
inline constexpr std::string_view report_format = "mis-report/1";

/// is_sobol: sequences of `at` samples.
struct Report : RunHead {
    double margin = 0.02;
    double at = 16;
    std::vector<SceneReport> scenes;
    std::vector<OverallReport> overall;  ///< by rank; empty unless there are several scenes
};

template <class Visitor, Either<Report> S> void describe(Visitor& v, S& report)
{
    describe_run(v, report, report_format);
    v.number(Field("margin"), report.margin);
    v.number(Field("at"), report.at);
    v.list(Field("scenes"), report.scenes, report);
    v.list(Field("overall"), report.overall);
    v.sentences(Field("sentences"), report);
}

}  // namespace mis
