#include "mis/words/verdict.h"

#include "mis/math/limits.h"
#include "mis/stats/at_counts.h"
#include "mis/stats/decision.h"
#include "mis/words/comparisons.h"
#include "mis/words/numbers.h"
#include "mis/words/same.h"
#include "mis/words/troubles.h"

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

/// What the best is measured against in the verdict, of those that are surely behind: the next, and
/// what is commonly used.
std::vector<int> alternatives(const SceneView& view, const SameStrategies& same,
                              const std::vector<int>& order)
{
    constexpr std::size_t most = 2;
    std::vector<int> found;
    for (std::size_t k = 1; k < order.size() && found.size() < most; ++k) {
        const std::string is = view.name(order[k]);
        const PairReport* p = view.pair(order[0], order[k]);
        if (!p || p->time_verdict != Verdict::apart || !same.is_first(order[k])) continue;
        if (found.empty() || is == "uniform/power" || is == "power/power" || is == "brdf")
            found.push_back(order[k]);
    }
    return found;
}

/// Those that could not be resolved, but are ahead of `best` by the samples that they have.
std::vector<std::string> perhaps_better(const SceneView& view, int best)
{
    std::vector<std::string> names;
    for (int i = 0; i < view.count(); ++i) {
        const StrategyReport &s = view.of(i), &b = view.of(best);
        const bool is_ahead =
            view.is_timed(best) ? s.seconds_to_1_percent.value * s.least_growth.relative_variance <
                                      b.seconds_to_1_percent.value
                                : s.variance.value * s.least_growth.variance < b.variance.value;
        if (s.status == Status::not_resolved && is_ahead) names.push_back(view.name(i));
    }
    return names;
}

/// Is every mean provably 0?
bool is_black(const SceneView& view, const std::vector<int>& order)
{
    return std::ranges::all_of(order,
                               [&](int i) { return view.of(i).exact && view.of(i).mean == 0; });
}

/// What would rank the first of those that rare samples keep from it.
std::string remedy(const SceneReport& scene)
{
    double least = infinity;
    for (const StrategyReport& s : scene.strategies)
        if (s.status == Status::not_resolved) least = std::min(least, s.resolving_factor);
    return std::isfinite(least) && least > 1
               ? ": about " + number(least, 2) + " times the samples (--spp, --time) may tell"
               : "";
}

std::string in_time(const SceneView& view, int i, int threads)
{
    return "it reaches 1 % error in " + duration(view.seconds(i)) + " on " +
           std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

std::vector<int> not_run(const SceneView& view)
{
    std::vector<int> strategies;
    for (int i = 0; i < view.count(); ++i)
        if (view.of(i).status == Status::not_run) strategies.push_back(i);
    return strategies;
}

/// CPU seconds that the first samples of those take; infinite where it is not known.
double seconds_of(const SceneView& view, const std::vector<int>& strategies)
{
    double sum = 0;
    for (const int i : strategies) {
        const double seconds = view.of(i).estimated_seconds;
        sum += seconds > 0 ? seconds : infinity;
    }
    return sum;
}

/// Where as many were not run as were ranked, what that takes.
void say_not_run(Sentences& sentences, const SceneView& view, std::size_t ranked)
{
    const std::vector<int> strategies = not_run(view);
    if (strategies.empty() || strategies.size() < ranked) return;
    const double seconds = seconds_of(view, strategies);
    const bool is_one = strategies.size() == 1;
    sentences.say((is_one ? view.name(strategies[0]) + " was"
                          : many(strategies.size(), "strategy") + " were") +
                  " not run" + (ranked > 0 ? ", and may be better" : "") +
                  (std::isfinite(seconds)
                       ? std::string("; ") + (is_one ? "its" : "their") +
                             " first samples take about " + duration(seconds) + " of CPU time"
                       : "") +
                  (view.scene().partial ? "" : " (more --time, or a lower --resolution, tells)"));
}

/// One strategy is ranked, others were not run: it is best of nothing.
void say_ranked_alone(Sentences& sentences, const SceneView& view, int alone, int threads)
{
    sentences.say("Not decided which to use: there was time to rank " + view.name(alone) +
                  " alone" + (view.is_timed(alone) ? "; " + in_time(view, alone, threads) : ""));
    say_not_run(sentences, view, 1);
}

void say_use(Sentences& sentences, const SceneView& view, int leader, int threads)
{
    sentences.say("Use " + view.name(leader) + ": " +
                  (view.is_timed(leader)
                       ? in_time(view, leader, threads)
                       : "it has the least variance per sample (no times were taken)"));
}

/// "6 more seconds".
std::string more_time(double seconds)
{
    const auto text = [&](double unit, const char* name) {
        const std::string count = number(std::max(1.0, std::ceil(seconds / unit)), 2);
        return count + " more " + name + (count == "1" ? "" : "s");
    };
    if (seconds < 100) return text(1, "second");
    return seconds < 7200 ? text(60, "minute") : text(3600, "hour");
}

/// The first of some names, and how many more there are.
std::string first_of(const std::vector<std::string>& names)
{
    constexpr std::size_t most = 4;
    if (names.size() <= most + 1) return listed(names);
    std::vector<std::string> first(names.begin(), names.begin() + most);
    first.push_back(std::to_string(names.size() - most) + " others");
    return listed(first);
}

/// Those that may be best beside the leader and what is the same, from the first to the last. Where
/// nothing else may be, those that are the same, but for the time they take.
std::vector<std::string> rivals(const SceneView& view, const SameStrategies& same,
                                const std::vector<int>& order)
{
    std::vector<std::string> names, twins;
    for (const int i : order) {
        if (!view.of(i).may_be_best || i == order[0]) continue;
        if (same.are_same(i, order[0])) twins.push_back(view.name(i));
        else if (same.is_first(i)) names.push_back(view.name(i));
    }
    return names.empty() ? twins : names;
}

/// What is sure of a leader for which it is decided.
std::string sure_to(const SceneView& view, int leader, bool has_rivals)
{
    const bool is_timed = view.is_timed(leader);
    const std::string most = has_rivals ? "at most " + percent(most_behind) : "no";
    return is_timed ? "be " + most + " slower than any other"
                    : "have " + most + " more variance than any other";
}

std::string undecided(const SceneView& view, int leader, const std::vector<std::string>& names)
{
    const double behind = view.of(leader).behind_at_most, seconds = view.scene().seconds_to_decide;
    const std::string share = percent(std::ceil(100 * behind / (1 + behind)) / 100);
    return "Not decided: " + first_of(names) + " may " +
           (!view.is_timed(leader)  ? "have less variance"
            : std::isfinite(behind) ? "be up to " + share + " sooner"
                                    : "be sooner") +
           (std::isfinite(seconds) ? "; about " + more_time(seconds) + " would decide" : "");
}

/// Sure are all things said of those that may be best: for all strategies together.
void say_how_sure(Sentences& sentences, const SceneView& view, const SameStrategies& same,
                  const std::vector<int>& order)
{
    const auto perhaps = perhaps_better(view, order[0]), names = rivals(view, same, order);
    if (order.size() == 1) {
        sentences.say("It is the only one that could be ranked");
    } else if (view.scene().decided) {
        sentences.say((view.scene().lacks_audit ? "By these samples it is sure to "
                       : perhaps.empty()        ? "It is sure to "
                                                : "Of those that are resolved it is sure to ") +
                      sure_to(view, order[0], !names.empty()) + " (95 %, all strategies together)");
    } else if (!names.empty()) {
        sentences.say(undecided(view, order[0], names));
    }
    if (!perhaps.empty())
        sentences.say("Not yet sure: " + first_of(perhaps) +
                      (perhaps.size() == 1 ? " is" : " are") +
                      " not resolved, and ahead of it by the samples so far; more time would tell");
}

/// What it saves, against those that are surely behind.
void say_gains(Sentences& sentences, const SceneView& view, const SameStrategies& same,
               const std::vector<int>& order)
{
    std::vector<std::string> gains;
    for (const int i : alternatives(view, same, order))
        if (view.is_timed(i) && view.sooner(order[0], i).value > 1)
            gains.push_back(with_error(view.sooner(order[0], i)) + " times sooner than " +
                            view.name(i));
    if (!gains.empty()) sentences.say("It reaches 1 % error " + listed(gains));
}

/// Where the leader draws more than one light for a sample, which of the others to use.
void say_use_of_one_light(Sentences& sentences, const SceneView& view, int leader, int threads)
{
    const SceneReport& scene = view.scene();
    const int best = view.find(scene.leader_of_one_light);
    if (best < 0 || best == leader || scene.lights < 2) return;
    const bool is_alone = scene.leader_of_one_light == "brdf";
    sentences.say(
        "Of those that draw one light per sample" + std::string(is_alone ? ", or none" : "") +
        ", use " + view.name(best) + ": " +
        (view.is_timed(best) ? in_time(view, best, threads) : "it has the least variance") +
        (scene.decided_of_one_light ? "" : " (that is not decided)"));
}

/// Time to 1 % relative error weighs all places alike; efficiency weighs bright ones most. Where
/// they disagree, say so.
void say_most_efficient(Sentences& sentences, const SceneView& view, int best)
{
    for (int i = 0; i < view.count(); ++i) {
        const PairReport* p =
            view.of(i).rank_by_efficiency == 1 && i != best ? view.pair(i, best) : nullptr;
        if (!p || p->efficiency_verdict != Verdict::apart) continue;
        const Interval gain = p->a == i ? p->efficiency_ratio : turned_over(p->efficiency_ratio);
        return sentences.say(
            "Where only bright places matter, use " + view.name(i) + ": by plain variance it is " +
            (std::isfinite(gain.value) ? with_error(gain) + " times " : "infinitely ") +
            "more efficient than " + view.name(best));
    }
}

void say_least_variance(Sentences& sentences, const SceneView& view, int best)
{
    for (int i = 0; i < view.count(); ++i) {
        const PairReport* p =
            view.of(i).rank == 1 && i != best && !view.of(i).exact ? view.pair(i, best) : nullptr;
        if (!p || p->verdict != Verdict::apart) continue;
        const double cost =
            view.of(i).seconds_per_sample.value / view.of(best).seconds_per_sample.value;
        return sentences.say(
            "Per sample " + view.name(i) + " has the least variance, " +
            with_error(turned_over(p->ratio)) + " times less than " + view.name(best) +
            (cost > 1.05 ? ", but its sample costs " + number(cost, 2) + " times as much" : ""));
    }
}

void say_lack_of_audit(Sentences& sentences, bool had_no_time)
{
    sentences.say(
        std::string(had_no_time ? "There was no time for an audit" : "Sequences are not audited") +
        ": a strategy that never drew what is rare would look better than it is, and one "
        "that did biased; " +
        (had_no_time ? "more time tells" : "--sampler independent tells"));
}

/// At further numbers of samples per point, the best where that is surely another.
void say_best_at_counts(Sentences& sentences, const SceneView& view, int leader)
{
    const std::vector<CountFigures>& counts = view.of(leader).at_counts;
    for (std::size_t k = 1; k < counts.size(); ++k)
        if (const auto found = best_at_count(view.scene(), leader, k))
            sentences.say("At " + counted(counts[k].n, "sample") + " " + view.name(found->best) +
                          " is best: it reaches the same error " + with_error(found->sooner) +
                          " times sooner than " + view.name(leader));
}

void say_verdict(Sentences& sentences, const SceneView& view, const SameStrategies& same,
                 int threads)
{
    std::vector<int> order = view.in_order();
    if (order.empty()) {
        sentences.say("No strategy could be ranked on this scene" + remedy(view.scene()));
        return say_not_run(sentences, view, 0);
    }
    if (is_black(view, order))
        return sentences.say(
            "No light reaches any point that was measured: all is black, by any strategy");
    const int leader = view.leader();
    std::erase(order, leader);
    order.insert(order.begin(), leader);
    if (order.size() == 1 && !not_run(view).empty())
        return say_ranked_alone(sentences, view, leader, threads);
    say_use(sentences, view, leader, threads);
    say_how_sure(sentences, view, same, order);
    say_not_run(sentences, view, order.size());
    say_gains(sentences, view, same, order);
    say_best_at_counts(sentences, view, leader);
    say_use_of_one_light(sentences, view, leader, threads);
    if (view.scene().lacks_audit) say_lack_of_audit(sentences, view.scene().had_no_time_for_audit);
    say_most_efficient(sentences, view, leader);
    say_least_variance(sentences, view, leader);
}

}  // namespace

SceneWords words_of(const SceneReport& scene, int threads, double margin)
{
    const SceneView view(scene);
    const SameStrategies same(view);
    Sentences answer, details;
    say_verdict(answer, view, same, threads);
    say_the_same(details, view, same);
    say_comparisons(details, view, same, margin);
    say_troubles(details, view);
    return {std::move(answer).all(), std::move(details).all()};
}

std::vector<std::string> sentences_of(const SceneReport& scene, int threads, double margin)
{
    SceneWords words = words_of(scene, threads, margin);
    words.answer.insert(words.answer.end(), words.details.begin(), words.details.end());
    return words.answer;
}

std::vector<std::string> overall_sentences_of(const Report& report)
{
    const auto best =
        std::find_if(report.overall.begin(), report.overall.end(),
                     [](const OverallReport& o) { return o.rank_by_efficiency == 1; });
    if (report.scenes.size() < 2) return {};
    if (best == report.overall.end())
        return {"No strategy was ranked on all scenes, so there is no overall ranking."};
    const std::string use =
        "Over all " + std::to_string(report.scenes.size()) + " scenes use " + best->name + ": ";
    std::vector<std::string> said{
        best->time_ratio.value < 1.005
            ? use + "on each it is among the first to reach 1 % error."
            : use + "it takes " + with_error(best->time_ratio) +
                  " times as long to 1 % error as the best of each scene (geometric mean)."};
    const std::size_t of = report.scenes[0].strategies.size();
    if (report.overall.size() < of)
        said.push_back("It is ranked among the " + std::to_string(report.overall.size()) + " of " +
                       std::to_string(of) +
                       " strategies that could be ranked on every scene; on a scene of your own "
                       "another may be better.");
    return said;
}

}  // namespace mis
