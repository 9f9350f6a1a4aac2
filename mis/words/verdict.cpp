#include "mis/words/verdict.h"

#include "mis/math/limits.h"
#include "mis/words/comparisons.h"
#include "mis/words/numbers.h"
#include "mis/words/troubles.h"

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

/// What the best is measured against in the verdict, of those that are surely behind: the next, and
/// what is commonly used.
std::vector<int> alternatives(const SceneView& view, const std::vector<int>& order)
{
    std::vector<int> found;
    for (std::size_t k = 1; k < order.size(); ++k) {
        const std::string is = view.name(order[k]);
        const PairReport* p = view.pair(order[0], order[k]);
        if (!p || p->time_verdict != Verdict::apart) continue;
        if (found.empty() || is == "uniform/power" || is == "power/power" || is == "brdf")
            found.push_back(order[k]);
    }
    return found;
}

/// Ranked strategies that stand to `best` like this, in time to 1 % (in variance without times).
std::vector<std::string> standing(const SceneView& view, int best, Verdict verdict)
{
    std::vector<std::string> names;
    for (const PairReport& p : view.scene().pairs) {
        if (p.a != best && p.b != best) continue;
        if ((view.is_timed(best) ? p.time_verdict : p.verdict) == verdict)
            names.push_back(view.name(p.a == best ? p.b : p.a));
    }
    return names;
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

void say_use(Sentences& sentences, const SceneView& view, const std::vector<int>& order,
             int threads)
{
    const int best = order[0];
    if (!view.is_timed(best))
        return sentences.say("Use " + view.name(best) +
                             ": it has the least variance per sample (no times were taken)");
    std::vector<std::string> gains;
    for (const int i : alternatives(view, order))
        if (view.is_timed(i) && view.sooner(best, i).value > 1)
            gains.push_back(with_error(view.sooner(best, i)) + " times sooner than " +
                            view.name(i));
    sentences.say("Use " + view.name(best) + ": it reaches 1 % error " +
                  (gains.empty() ? "" : listed(gains) + " (") + "in " +
                  duration(view.seconds(best)) + " on " + std::to_string(threads) +
                  (threads == 1 ? " thread" : " threads") + (gains.empty() ? "" : ")"));
}

void say_how_sure(Sentences& sentences, const SceneView& view, int best, double margin)
{
    const bool lacks_audit = view.scene().lacks_audit;
    const auto perhaps = perhaps_better(view, best);
    if (!perhaps.empty())
        sentences.say("Not yet sure: " + listed(perhaps) + (perhaps.size() == 1 ? " is" : " are") +
                      " not resolved, and ahead of it by the samples so far; more time would tell");
    const auto tied = standing(view, best, Verdict::tied),
               undecided = standing(view, best, Verdict::undecided);
    const char* what = view.is_timed(best) ? "time to 1 % error" : "variance";
    if (view.scene().pairs.empty()) return sentences.say("It is the only one that could be ranked");
    if (tied.empty() && undecided.empty())
        return sentences.say((lacks_audit ? "By these samples it leads in "
                              : perhaps.empty()
                                  ? "It is sure to lead in "
                                  : "Of those that are resolved it is sure to lead in ") +
                             std::string(what) + " (95 %, all pairs together)");
    if (!tied.empty())
        sentences.say(listed(tied) + (tied.size() == 1 ? " is" : " are") +
                      " as good: tied with it in " + what + " within " + percent(margin));
    if (!undecided.empty())
        sentences.say("Not yet sure: " + listed(undecided) + " may be as good, or better, in " +
                      what);
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

constexpr double nearly_as_fast = 1.05;

/// Of exact ones that may be as fast as the fastest, and are but for some per cent, the first that
/// was asked for leads: the clock's noise alone would turn the verdict from run to run.
void put_leader_first(const SceneView& view, std::vector<int>& order)
{
    const int fastest = order[0];
    const auto may_lead = [&](int i) {
        const PairReport* p = view.pair(fastest, i);
        return i == fastest || (view.of(i).exact && p && p->time_verdict != Verdict::apart &&
                                view.sooner(fastest, i).value < nearly_as_fast);
    };
    if (!view.of(fastest).exact) return;
    auto leader = order.begin();
    for (auto i = order.begin(); i != order.end(); ++i)
        if (may_lead(*i) && *i < *leader) leader = i;
    std::rotate(order.begin(), leader, leader + 1);
}

void say_verdict(Sentences& sentences, const SceneView& view, int threads, double margin)
{
    std::vector<int> order = view.in_order();
    if (order.empty())
        return sentences.say("No strategy could be ranked on this scene" + remedy(view.scene()));
    if (is_black(view, order))
        return sentences.say(
            "No light reaches any point that was measured: all is black, by any strategy");
    put_leader_first(view, order);
    say_use(sentences, view, order, threads);
    say_how_sure(sentences, view, order[0], margin);
    if (view.scene().lacks_audit) say_lack_of_audit(sentences, view.scene().had_no_time_for_audit);
    say_most_efficient(sentences, view, order[0]);
    say_least_variance(sentences, view, order[0]);
}

}  // namespace

SceneWords words_of(const SceneReport& scene, int threads, double margin)
{
    const SceneView view(scene);
    Sentences answer, details;
    say_verdict(answer, view, threads, margin);
    say_comparisons(details, view, margin);
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
