#include "mis/compare/sentences.h"

#include "mis/compare/words.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mis {
namespace {

constexpr std::size_t most_undecided = 5;  // pairs named; the rest is a number

class SceneWords {
public:
    SceneWords(const SceneReport& scene, int threads, double margin)
        : scene_(scene), threads_(threads), margin_(margin)
    {
    }

    std::vector<std::string> all()
    {
        say_verdict();
        say_least_variance();
        say_exact();
        say_ties();
        say_undecided();
        say_excluded();
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

    bool are_timed() const
    {
        return std::any_of(scene_.strategies.begin(), scene_.strategies.end(),
                           [](const StrategyReport& s) { return s.rank_by_efficiency == 1; });
    }

    /// The first in rank, by efficiency if times were taken.
    std::optional<int> best() const
    {
        for (int i = 0; i < count(); ++i)
            if ((are_timed() ? of(i).rank_by_efficiency : of(i).rank) == 1) return i;
        return std::nullopt;
    }

    /// What the best is measured against in the verdict.
    std::vector<int> alternatives(int best) const
    {
        std::vector<int> found;
        for (const char* usual : {"uniform/power", "power/power", "brdf"})
            for (int i = 0; i < count(); ++i)
                if (i != best && of(i).status == Status::ranked && name(i) == usual)
                    found.push_back(i);
        if (!found.empty()) return found;
        for (int i = 0; i < count(); ++i)
            if (i != best && of(i).rank_by_efficiency > 0 &&
                (found.empty() || of(i).rank_by_efficiency < of(found[0]).rank_by_efficiency))
                found.assign(1, i);
        return found;
    }

    /// Ranked strategies that stand to `best` like this, by efficiency (by variance without times).
    std::vector<std::string> standing(int best, Verdict verdict) const
    {
        std::vector<std::string> names;
        for (const PairReport& p : scene_.pairs) {
            if (p.a != best && p.b != best) continue;
            if ((are_timed() ? p.efficiency_verdict : p.verdict) == verdict)
                names.push_back(name(p.a == best ? p.b : p.a));
        }
        return names;
    }

    void say_verdict()
    {
        const std::optional<int> first = best();
        if (!first) return say("No strategy could be ranked on this scene");
        const int b = *first;
        std::vector<std::string> gains;
        if (are_timed())
            for (const int i : alternatives(b))
                if (const Interval gain = sooner(b, i); gain.value > 1)
                    gains.push_back(with_error(gain) + " times sooner than " + name(i));
        std::string verdict = "Use " + name(b);
        if (!gains.empty()) verdict += ": it reaches 1 % error " + listed(gains);
        else if (are_timed()) verdict += ": it is the most efficient";
        else verdict += ": it has the least variance per sample (no times were taken)";
        if (const double seconds = of(b).seconds_to_1_percent.value; std::isfinite(seconds))
            verdict += " (in " + duration(seconds) + " on " + std::to_string(threads_) +
                       (threads_ == 1 ? " thread)" : " threads)");
        say(verdict);
        say_how_sure(b);
        say_soonest(b);
    }

    void say_how_sure(int b)
    {
        const auto tied = standing(b, Verdict::tied), undecided = standing(b, Verdict::undecided);
        const char* what = are_timed() ? "efficiency" : "variance";
        if (scene_.pairs.empty())
            return say(
                "It is the only one that could be ranked, so its mean was not tested against "
                "another's");
        if (tied.empty() && undecided.empty())
            return say(std::string("It is sure to lead in ") + what +
                       " (95 %, all pairs together)");
        if (!tied.empty())
            say(listed(tied) + (tied.size() == 1 ? " is" : " are") + " as good: tied with it in " +
                what + " within " + percent(margin_));
        if (!undecided.empty())
            say("Not yet sure: " + listed(undecided) + " may be as good, or better, in " + what);
    }

    /// Efficiency weighs bright places most; time to 1 % relative error weighs all alike. Where
    /// they disagree, say so.
    void say_soonest(int b)
    {
        int soonest = b;
        for (int i = 0; i < count(); ++i)
            if (of(i).status == Status::ranked &&
                of(i).seconds_to_1_percent.value < of(soonest).seconds_to_1_percent.value)
                soonest = i;
        const PairReport* p = soonest == b ? nullptr : pair(b, soonest);
        if (p && p->time_verdict == Verdict::apart)
            say("Where dark places count as much as bright ones, use " + name(soonest) +
                ": it reaches 1 % relative error " + with_error(sooner(soonest, b)) +
                " times sooner than " + name(b));
    }

    void say_least_variance()
    {
        const std::optional<int> first = best();
        for (int i = 0; i < count(); ++i) {
            if (of(i).rank != 1 || !first || i == *first || of(i).exact) continue;
            const PairReport* p = pair(i, *first);
            if (!p || p->verdict != Verdict::apart) return;
            const double cost =
                of(i).seconds_per_sample.value / of(*first).seconds_per_sample.value;
            say("Per sample " + name(i) + " has the least variance, " +
                with_error(turned_over(p->ratio)) + " times less than " + name(*first) +
                (cost > 1 ? ", but its sample costs " + number(cost, 2) + " times as much" : ""));
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

    void say_ties()
    {
        for (const PairReport& p : scene_.pairs)
            if (p.verdict == Verdict::tied && !of(p.a).exact)
                say(name(p.a) + " and " + name(p.b) + " are tied in variance within " +
                    percent(margin_) + " (ratio " + with_error(p.ratio) + ")");
    }

    void say_undecided()
    {
        std::size_t undecided = 0;
        for (const PairReport& p : scene_.pairs) {
            if (p.verdict != Verdict::undecided || ++undecided > most_undecided) continue;
            say(name(p.a) + " and " + name(p.b) + " are undecided in variance (ratio " +
                with_error(p.ratio) + ")" +
                (std::isfinite(p.more_replicates)
                     ? ": about " + number(p.more_replicates, 2) + " more replicates would decide"
                     : ""));
        }
        if (undecided > most_undecided)
            say(std::to_string(undecided - most_undecided) + " more pairs are undecided");
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
                    " samples that are no numbers and were left out: do not trust its figures");
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
        return {"No strategy was ranked on all scenes, so there is no overall ranking."};
    const std::string use =
        "Over all " + std::to_string(report.scenes.size()) + " scenes use " + best->name + ": ";
    if (best->time_ratio.value < 1.005)
        return {use + "on each it is among the first to reach 1 % error."};
    return {use + "it takes " + with_error(best->time_ratio) +
            " times as long to 1 % error as the best of each scene (geometric mean)."};
}

}  // namespace mis
