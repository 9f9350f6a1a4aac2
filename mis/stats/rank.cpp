#include "mis/stats/rank.h"

#include "mis/stats/bias.h"
#include "mis/stats/figures.h"
#include "mis/stats/pairs.h"
#include "mis/stats/resolved.h"
#include "mis/strategy/names.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace mis {
namespace {

void exclude(StrategyReport& report, Status status, Reason why)
{
    report.status = status;
    report.reason = std::move(why);
}

/// Of all light, as far as shared directions know.
double never_drawn(const StrategyMeasurements& s)
{
    return s.shared && s.shared->missed > 0 ? s.shared->missed / s.mean_checks.front().shared : 0;
}

/// Gives each strategy its state.
void set_states(std::vector<StrategyReport>& reports, const SceneMeasurements& scene,
                double bias_error)
{
    std::vector<const StrategyMeasurements*> resolved;
    std::vector<std::size_t> index;
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const StrategyMeasurements& s = scene.strategies[i];
        Reason unresolved = s.was_run ? why_not_resolved(s) : Reason();
        if (!s.was_run) {
            exclude(reports[i], Status::not_run, s.not_run_reason);
        } else if (!is_none(unresolved)) {
            exclude(reports[i], Status::not_resolved, std::move(unresolved));
            reports[i].resolving_factor = resolving_factor(s);
            reports[i].least_growth = audited_growth(s);
            reports[i].exact = false;
        } else {
            reports[i].status = Status::ranked;
            resolved.push_back(&s);
            index.push_back(i);
        }
    }
    const bool are_beside_shared = std::ranges::all_of(
        resolved, [](const StrategyMeasurements* s) { return !s->mean_checks.empty(); });
    const std::vector<BiasFinding> findings = are_beside_shared
                                                  ? find_bias_beside_shared(resolved, bias_error)
                                                  : find_bias(resolved, bias_error);
    double tests = 0;  // that share the error
    for (const StrategyMeasurements* s : resolved)
        tests += static_cast<double>(s->mean_checks.size());
    for (std::size_t k = 0; k < resolved.size(); ++k) {
        StrategyReport& report = reports[index[k]];
        report.bias_p_value = findings[k].p_value;
        report.least_detectable_bias = least_detectable_bias(*resolved[k], bias_error, tests);
        if (const double share = never_drawn(*resolved[k]); share > rounding_of_means) {
            exclude(report, Status::biased, reason::NeverDraws{share});
            report.exact = false;
            continue;
        }
        if (!findings[k].biased) continue;
        reason::MeanDiffers why = findings[k].why;
        why.may_lack_rare_samples =
            !resolved[k]->shared && may_lack_rare_samples(findings[k], *resolved[k]);
        exclude(report, why.may_lack_rare_samples ? Status::not_resolved : Status::biased, why);
        report.exact = false;
    }
}

using LogRatio = LogEstimate (*)(const Figures&, const Figures&);

/// Members from best to worst by one figure, ties in their own order.
std::vector<int> sorted_by(LogRatio ratio, std::vector<int> members,
                           const std::vector<Figures>& figures)
{
    std::stable_sort(members.begin(), members.end(),
                     [&](int a, int b) { return ratio(figures[a], figures[b]).value < 0; });
    return members;
}

/// Every pair of `members`, decided.
std::vector<Comparison> compared_by(LogRatio ratio, const std::vector<int>& members,
                                    const std::vector<Figures>& figures, double margin,
                                    double error)
{
    std::vector<Comparison> family;
    for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t j = i + 1; j < members.size(); ++j)
            family.push_back(
                {members[i], members[j], ratio(figures[members[i]], figures[members[j]])});
    decide(family, margin, error);
    return family;
}

/// What an earlier look decided stands; but not that a is better once it no longer is.
void let_stand(const SceneReport& earlier, std::span<Comparison> family)
{
    for (Comparison& now : family)
        for (const PairReport& then : earlier.pairs) {
            if (now.verdict != Verdict::undecided) break;
            const bool is_turned = now.a == then.b && now.b == then.a;
            if ((now.a == then.a && now.b == then.b) ||
                (is_turned && then.verdict == Verdict::tied))
                now.verdict = then.verdict;
        }
}

/// 1 + how many are better: equal figures share a rank.
int rank_among(LogRatio ratio, int member, const std::vector<int>& members,
               const std::vector<Figures>& figures)
{
    return 1 + static_cast<int>(std::count_if(members.begin(), members.end(), [&](int other) {
               return ratio(figures[other], figures[member]).value < 0;
           }));
}

void set_ranks(std::vector<StrategyReport>& reports, const std::vector<Comparison>& by_variance,
               const std::vector<int>& members, const std::vector<Figures>& figures)
{
    const std::vector<RankInterval> places = rank_intervals(by_variance, members, reports.size());
    for (const int i : members) {
        reports[i].rank = rank_among(log_variance_ratio, i, members, figures);
        reports[i].rank_low = places[i].low;
        reports[i].rank_high = places[i].high;
    }
    for (const Comparison& pair : by_variance) {
        if (pair.verdict != Verdict::tied) continue;
        reports[pair.a].tied_with.push_back(name_of(reports[pair.b].strategy));
        reports[pair.b].tied_with.push_back(name_of(reports[pair.a].strategy));
    }
}

void set_ranks_by_efficiency(std::vector<StrategyReport>& reports,
                             const std::vector<Comparison>& by_cost,
                             const std::vector<int>& members, const std::vector<Figures>& figures)
{
    const std::vector<RankInterval> places = rank_intervals(by_cost, members, reports.size());
    for (const int i : members) {
        reports[i].rank_by_efficiency = rank_among(log_cost_ratio, i, members, figures);
        reports[i].rank_by_efficiency_low = places[i].low;
        reports[i].rank_by_efficiency_high = places[i].high;
    }
}

const Comparison* find(const std::vector<Comparison>& family, int a, int b)
{
    const auto it = std::find_if(family.begin(), family.end(), [&](const Comparison& c) {
        return (c.a == a && c.b == b) || (c.a == b && c.b == a);
    });
    return it == family.end() ? nullptr : &*it;
}

/// The standings of an earlier look; none where others were ranked then.
std::vector<Standing> earlier_standings(const SceneReport* earlier,
                                        const std::vector<StrategyReport>& now)
{
    std::vector<Standing> standings;
    if (!earlier || earlier->leader.empty() || earlier->strategies.size() != now.size()) return {};
    for (std::size_t i = 0; i < now.size(); ++i) {
        const StrategyReport& then = earlier->strategies[i];
        if ((then.status == Status::ranked) != (now[i].status == Status::ranked)) return {};
        standings.push_back({then.may_be_best, then.behind_at_most});
    }
    return standings;
}

/// Draws towards lights of one sample: none, or one.
bool draws_one_light(const Strategy& s)
{
    return !s.chooses_light() || (!draws_every_light(s.policy) && s.counts[0] == 1);
}

bool is_the_clock_all_that_tells(const StrategyReport& a, const StrategyReport& b)
{
    return (a.exact && b.exact) || have_same_samples(a, b);
}

/// Of `members` and the pairs of one figure.
void decide_which_to_use(Ranking& ranking, std::vector<int> members,
                         std::span<const Comparison> pairs, double error,
                         const SceneReport* earlier)
{
    std::vector<StrategyReport>& reports = ranking.strategies;
    std::sort(members.begin(), members.end());  // as they were asked for
    const std::vector<Standing> before = earlier_standings(earlier, reports);
    Contenders among{members, pairs, reports.size(), error, before};
    among.are_alike = [&](int i, int j) {
        return is_the_clock_all_that_tells(reports[i], reports[j]);
    };
    ranking.decision = decide_best(among);
    for (const int i : members) {
        reports[i].may_be_best = ranking.decision.of[i].may_be_best;
        reports[i].behind_at_most = ranking.decision.of[i].behind_at_most;
    }
    among.earlier = {};
    std::erase_if(members, [&](int i) { return !draws_one_light(reports[i].strategy); });
    among.members = members;
    ranking.of_one_light = decide_best(among);
}

/// Is every variance of those that are ranked known?
bool are_variances_known(const std::vector<StrategyReport>& reports)
{
    return std::ranges::all_of(reports, [](const StrategyReport& s) {
        return s.status != Status::ranked || is_known_to(variance_is_known, s.variance);
    });
}

std::string leader_name(const Decision& decision, const std::vector<StrategyReport>& strategies)
{
    return decision.leader < 0 ? "" : name_of(strategies[decision.leader].strategy);
}

}  // namespace

void put_ranking(Ranking ranking, double seconds, SceneReport& scene)
{
    scene.decided = ranking.decision.is_decided;
    scene.leader = leader_name(ranking.decision, ranking.strategies);
    scene.decided_of_one_light = ranking.of_one_light.is_decided;
    scene.leader_of_one_light = leader_name(ranking.of_one_light, ranking.strategies);
    scene.seconds_to_decide = seconds * ranking.decision.more;
    scene.settled = ranking.settled;
    scene.replicates = ranking.replicates;
    scene.seconds = seconds;
    scene.strategies = std::move(ranking.strategies);
    scene.pairs = std::move(ranking.pairs);
}

Ranking rank(const SceneMeasurements& scene, const RankOptions& options)
{
    Ranking ranking;
    std::vector<Figures> figures;
    int replicates = std::numeric_limits<int>::max();
    for (const StrategyMeasurements& s : scene.strategies) {
        figures.push_back(figures_of(s, options.at));
        ranking.strategies.push_back(report_of(s, figures.back(), scene.points, options.threads));
        if (s.was_run)
            replicates = std::min(replicates, static_cast<int>(figures.back().variances.size()));
    }
    remove_drift(figures);
    ranking.replicates = replicates == std::numeric_limits<int>::max() ? 0 : replicates;
    set_states(ranking.strategies, scene, options.bias_error * options.share);

    std::vector<int> ranked, timed;
    for (std::size_t i = 0; i < scene.strategies.size(); ++i) {
        if (ranking.strategies[i].status != Status::ranked) continue;
        ranked.push_back(static_cast<int>(i));
        if (!std::isnan(ranking.strategies[i].efficiency.value))
            timed.push_back(static_cast<int>(i));
    }
    ranked = sorted_by(log_variance_ratio, std::move(ranked), figures);
    const double error = options.family_error * options.share;
    auto by_variance = compared_by(log_variance_ratio, ranked, figures, options.margin, error);
    if (options.earlier) let_stand(*options.earlier, by_variance);
    const auto by_cost = compared_by(log_cost_ratio, timed, figures, options.margin, error);
    const auto by_time = compared_by(log_time_ratio, timed, figures, options.margin, error);
    set_ranks(ranking.strategies, by_variance, ranked, figures);
    set_ranks_by_efficiency(ranking.strategies, by_cost, timed, figures);

    decide_which_to_use(ranking, timed.empty() ? ranked : timed,
                        timed.empty() ? by_variance : by_time, error, options.earlier);
    ranking.settled = ranking.decision.is_decided && are_variances_known(ranking.strategies);
    for (const Comparison& c : by_variance) {
        PairReport pair;
        pair.a = c.a;
        pair.b = c.b;
        pair.ratio = interval_of(c.log_ratio);
        pair.verdict = c.verdict;
        pair.more_replicates =
            replicates_to_decide(c, by_variance.size(), replicates, options.margin, error);
        pair.efficiency_ratio = pair.time_ratio = unknown_interval();
        if (const Comparison* cost = find(by_cost, c.a, c.b)) {
            const Comparison* time = find(by_time, c.a, c.b);
            pair.efficiency_ratio =
                interval_of(turned_over(log_cost_ratio(figures[c.a], figures[c.b])));
            pair.efficiency_verdict = cost->verdict;
            pair.time_ratio = interval_of(log_time_ratio(figures[c.a], figures[c.b]));
            pair.time_verdict = time->verdict;
        }
        ranking.pairs.push_back(pair);
    }
    return ranking;
}

}  // namespace mis
