#include "mis/compare/sentences.h"

#include "mis/compare/schedule.h"
#include "mis/compare/words.h"
#include "mis/math/limits.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace mis {
namespace {

constexpr std::size_t most_pairs = 5;  // named, undecided or tied; the rest is a number

class SceneWords {
public:
    SceneWords(const SceneReport& scene, int threads, double margin)
        : scene_(scene), threads_(threads), margin_(margin)
    {
    }

    std::vector<std::string> all()
    {
        say_verdict();
        say_exact();
        say_ties();
        say_undecided();
        say_excluded();
        if (!scene_.partial && scene_.replicates > 1 && scene_.replicates < most_replicates &&
            has_intervals())
            say("Intervals are rough: there was room for " + std::to_string(scene_.replicates) +
                " replicates, not " + std::to_string(most_replicates) + " (--spp)");
        return std::move(said_);
    }

private:
    std::string name(int i) const { return name_of(scene_.strategies[i].strategy); }
    const StrategyReport& of(int i) const { return scene_.strategies[i]; }
    int count() const { return static_cast<int>(scene_.strategies.size()); }
    void say(const std::string& sentence) { said_.push_back(sentence + "."); }

    const PairReport* pair(int i, int j) const
    {
        for (const PairReport& p : scene_.pairs)
            if ((p.a == i && p.b == j) || (p.a == j && p.b == i)) return &p;
        return nullptr;
    }

    static Interval turned_over(const Interval& x) { return {1 / x.value, 1 / x.high, 1 / x.low}; }

    /// How many times sooner i reaches 1 % than j.
    Interval sooner(int i, int j) const
    {
        const PairReport* p = pair(i, j);
        if (!p) return {1, 1, 1};
        return p->b == i ? p->time_ratio : turned_over(p->time_ratio);
    }

    /// Wall seconds to 1 %; infinite where it is not ranked or not known.
    double seconds(int i) const
    {
        const double seconds = of(i).seconds_to_1_percent.value;
        return of(i).status == Status::ranked && !std::isnan(seconds) ? seconds : infinity;
    }

    /// Ranked strategies from the soonest to the last, without times by variance.
    std::vector<int> in_order() const
    {
        std::vector<int> order;
        for (int i = 0; i < count(); ++i)
            if (of(i).status == Status::ranked) order.push_back(i);
        std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
            return std::pair(seconds(a), of(a).rank) < std::pair(seconds(b), of(b).rank);
        });
        return order;
    }

    bool is_timed(int i) const { return std::isfinite(seconds(i)); }

    /// What the best is measured against in the verdict, of those that are surely behind: the
    /// next, and what is commonly used.
    std::vector<int> alternatives(const std::vector<int>& order) const
    {
        std::vector<int> found;
        for (std::size_t k = 1; k < order.size(); ++k) {
            const std::string is = name(order[k]);
            const PairReport* p = pair(order[0], order[k]);
            if (!p || p->time_verdict != Verdict::apart) continue;
            if (found.empty() || is == "uniform/power" || is == "power/power" || is == "brdf")
                found.push_back(order[k]);
        }
        return found;
    }

    /// Ranked strategies that stand to `best` like this, in time to 1 % (in variance without
    /// times).
    std::vector<std::string> standing(int best, Verdict verdict) const
    {
        std::vector<std::string> names;
        for (const PairReport& p : scene_.pairs) {
            if (p.a != best && p.b != best) continue;
            if ((is_timed(best) ? p.time_verdict : p.verdict) == verdict)
                names.push_back(name(p.a == best ? p.b : p.a));
        }
        return names;
    }

    void say_verdict()
    {
        const std::vector<int> order = in_order();
        if (order.empty()) return say("No strategy could be ranked on this scene" + remedy());
        if (is_black(order))
            return say(
                "No light reaches any point that was measured: all is black, "
                "by any strategy");
        const int best = order[0];
        std::vector<std::string> gains;
        for (const int i : alternatives(order))
            if (is_timed(i) && sooner(best, i).value > 1)
                gains.push_back(with_error(sooner(best, i)) + " times sooner than " + name(i));
        std::string verdict = "Use " + name(best);
        if (!is_timed(best))
            verdict += ": it has the least variance per sample (no times were taken)";
        else
            verdict += ": it reaches 1 % error " + (gains.empty() ? "" : listed(gains) + " (") +
                       "in " + duration(seconds(best)) + " on " + std::to_string(threads_) +
                       (threads_ == 1 ? " thread" : " threads") + (gains.empty() ? "" : ")");
        say(verdict);
        say_how_sure(best);
        if (scene_.lacks_audit)
            say((scene_.had_no_time_for_audit ? "There was no time for an audit"
                                              : "Sequences are not audited") +
                std::string(": a strategy that never drew what is rare would look "
                            "better than it "
                            "is, and one that did biased; ") +
                (scene_.had_no_time_for_audit ? "more time tells" : "--sampler independent tells"));
        say_most_efficient(best);
        say_least_variance(best);
    }

    bool has_intervals() const
    {
        return std::ranges::any_of(scene_.strategies, [](const StrategyReport& s) {
            return s.status == Status::ranked && !s.exact;
        });
    }

    /// Is every mean provably 0?
    bool is_black(const std::vector<int>& order) const
    {
        return std::ranges::all_of(order, [&](int i) { return of(i).exact && of(i).mean == 0; });
    }

    /// What would rank the first of those that rare samples keep from it.
    std::string remedy() const
    {
        double least = infinity;
        for (const StrategyReport& s : scene_.strategies)
            if (s.status == Status::not_resolved) least = std::min(least, s.resolving_factor);
        return std::isfinite(least) && least > 1
                   ? ": about " + number(least, 2) + " times the samples (--spp, --time) may tell"
                   : "";
    }

    /// Those that could not be resolved, but are ahead of `best` by the samples that they have.
    std::vector<std::string> perhaps_better(int best) const
    {
        std::vector<std::string> names;
        for (int i = 0; i < count(); ++i) {
            const StrategyReport &s = of(i), &b = of(best);
            const bool is_ahead =
                is_timed(best) ? s.seconds_to_1_percent.value * s.least_growth.relative_variance <
                                     b.seconds_to_1_percent.value
                               : s.variance.value * s.least_growth.variance < b.variance.value;
            if (s.status == Status::not_resolved && is_ahead) names.push_back(name(i));
        }
        return names;
    }

    void say_how_sure(int best)
    {
        const auto perhaps = perhaps_better(best);
        if (!perhaps.empty())
            say("Not yet sure: " + listed(perhaps) + (perhaps.size() == 1 ? " is" : " are") +
                " not resolved, and ahead of it by the samples so far; more time "
                "would tell");
        const auto tied = standing(best, Verdict::tied),
                   undecided = standing(best, Verdict::undecided);
        const char* what = is_timed(best) ? "time to 1 % error" : "variance";
        if (scene_.pairs.empty()) return say("It is the only one that could be ranked");
        if (tied.empty() && undecided.empty())
            return say((scene_.lacks_audit ? "By these samples it leads in "
                        : perhaps.empty()  ? "It is sure to lead in "
                                           : "Of those that are resolved it is sure to lead in ") +
                       std::string(what) + " (95 %, all pairs together)");
        if (!tied.empty())
            say(listed(tied) + (tied.size() == 1 ? " is" : " are") + " as good: tied with it in " +
                what + " within " + percent(margin_));
        if (!undecided.empty())
            say("Not yet sure: " + listed(undecided) + " may be as good, or better, in " + what);
    }

    /// Time to 1 % relative error weighs all places alike; efficiency weighs bright ones most.
    /// Where they disagree, say so.
    void say_most_efficient(int best)
    {
        for (int i = 0; i < count(); ++i) {
            const PairReport* p =
                of(i).rank_by_efficiency == 1 && i != best ? pair(i, best) : nullptr;
            if (!p || p->efficiency_verdict != Verdict::apart) continue;
            const Interval gain =
                p->a == i ? p->efficiency_ratio : turned_over(p->efficiency_ratio);
            say("Where only bright places matter, use " + name(i) + ": by plain variance it is " +
                (std::isfinite(gain.value) ? with_error(gain) + " times " : "infinitely ") +
                "more efficient than " + name(best));
            return;
        }
    }

    void say_least_variance(int best)
    {
        for (int i = 0; i < count(); ++i) {
            const PairReport* p =
                of(i).rank == 1 && i != best && !of(i).exact ? pair(i, best) : nullptr;
            if (!p || p->verdict != Verdict::apart) continue;
            const double cost = of(i).seconds_per_sample.value / of(best).seconds_per_sample.value;
            say("Per sample " + name(i) + " has the least variance, " +
                with_error(turned_over(p->ratio)) + " times less than " + name(best) +
                (cost > 1.05 ? ", but its sample costs " + number(cost, 2) + " times as much"
                             : ""));
            return;
        }
    }

    void say_exact()
    {
        std::vector<std::string> names;
        for (int i = 0; i < count(); ++i)
            if (of(i).exact && of(i).status == Status::ranked) names.push_back(name(i));
        if (!names.empty())
            say(listed(names) + (names.size() == 1 ? " is" : " are") +
                " exact here: every sample gives the result");
    }

    bool are_tied(int i, int j) const
    {
        const PairReport* p = pair(i, j);
        return p && p->verdict == Verdict::tied;
    }

    /// Ranked strategies of which each is tied with each, in variance: greedily, from the first on.
    std::vector<std::vector<int>> tied_groups() const
    {
        std::vector<std::vector<int>> groups;
        for (const int i : in_order()) {
            if (of(i).exact) continue;
            const auto group = std::ranges::find_if(groups, [&](const std::vector<int>& members) {
                return std::ranges::all_of(members, [&](int j) { return are_tied(i, j); });
            });
            if (group == groups.end()) groups.push_back({i});
            else group->push_back(i);
        }
        return groups;
    }

    void say_ties()
    {
        std::set<std::pair<int, int>> told;
        for (const std::vector<int>& group : tied_groups()) {
            if (group.size() < 3) continue;
            std::vector<std::string> names;
            for (const int i : group) {
                names.push_back(name(i));
                for (const int j : group) told.emplace(i, j);
            }
            say(listed(names) + " are tied in variance, each with each, within " +
                percent(margin_));
        }
        std::size_t pairs = 0;
        for (const PairReport& p : scene_.pairs) {
            if (p.verdict != Verdict::tied || of(p.a).exact || told.contains({p.a, p.b})) continue;
            if (++pairs > most_pairs) continue;
            say(name(p.a) + " and " + name(p.b) + " are tied in variance within " +
                percent(margin_) + " (ratio " + with_error(p.ratio) + ")");
        }
        if (pairs > most_pairs) say(std::to_string(pairs - most_pairs) + " more pairs are tied");
    }

    /// "290 more replicates (19 times as many samples)".
    std::string replicates(double more) const
    {
        const std::string text = number(more, 2) + " more replicates";
        return scene_.replicates < 1 ? text
                                     : text + " (" + number(1 + more / scene_.replicates, 2) +
                                           " times as many samples)";
    }

    void say_undecided()
    {
        std::size_t undecided = 0;
        for (const PairReport& p : scene_.pairs) {
            if (p.verdict != Verdict::undecided || ++undecided > most_pairs) continue;
            say(name(p.a) + " and " + name(p.b) + " are undecided in variance (ratio " +
                with_error(p.ratio) + ")" +
                (std::isfinite(p.more_replicates)
                     ? ": about " + replicates(p.more_replicates) + " would decide"
                     : ""));
        }
        if (undecided > most_pairs)
            say(std::to_string(undecided - most_pairs) + " more pairs are undecided");
    }

    void say_excluded()
    {
        for (int i = 0; i < count(); ++i) {
            const StrategyReport& s = of(i);
            if (s.status == Status::not_resolved) say(name(i) + " is not resolved: " + s.reason);
            if (s.status == Status::biased) say(name(i) + " is biased: " + s.reason);
            if (s.status == Status::not_run)
                say(name(i) + " was not run: " + s.reason +
                    (s.estimated_seconds > 0 ? " (it would take about " +
                                                   duration(s.estimated_seconds) + " of CPU time)"
                                             : ""));
            if (s.invalid_samples > 0)
                say(name(i) + " gave " + std::to_string(s.invalid_samples) +
                    " samples that are no numbers and were left out: do not trust its "
                    "figures; "
                    "'" +
                    replay_words(scene_.file, s.strategy, s.first_invalid) +
                    "' with this run's --seed and --resolution shows the first");
        }
        if (scene_.partial) say("Stopped early: these are the results so far");
    }

    const SceneReport& scene_;
    int threads_;
    double margin_;
    std::vector<std::string> said_;
};

}  // namespace

std::vector<std::string> sentences_of(const SceneReport& scene, int threads, double margin)
{
    return SceneWords(scene, threads, margin).all();
}

std::vector<std::string> overall_sentences_of(const Report& report)
{
    const auto best =
        std::find_if(report.overall.begin(), report.overall.end(),
                     [](const OverallReport& o) { return o.rank_by_efficiency == 1; });
    if (report.scenes.size() < 2) return {};
    if (best == report.overall.end())
        return {
            "No strategy was ranked on all scenes, so there is no overall "
            "ranking."};
    const std::string use =
        "Over all " + std::to_string(report.scenes.size()) + " scenes use " + best->name + ": ";
    std::vector<std::string> said{best->time_ratio.value < 1.005
                                      ? use + "on each it is among the first to reach 1 % error."
                                      : use + "it takes " + with_error(best->time_ratio) +
                                            " times as long to 1 % error as the best of each scene "
                                            "(geometric mean)."};
    const std::size_t of = report.scenes[0].strategies.size();
    if (report.overall.size() < of)
        said.push_back("It is ranked among the " + std::to_string(report.overall.size()) + " of " +
                       std::to_string(of) +
                       " strategies that could be ranked on every scene; on a "
                       "scene of your own "
                       "another may be better.");
    return said;
}

}  // namespace mis
