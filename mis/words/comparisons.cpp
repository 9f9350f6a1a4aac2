#include "mis/words/comparisons.h"

#include "mis/words/numbers.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace mis {
namespace {

// Named; the rest is a number. Those that are undecided do not say which strategy to use.
constexpr std::size_t most_pairs = 3, most_undecided = 2;

void say_exact(Sentences& sentences, const SceneView& view)
{
    std::vector<std::string> names;
    for (int i = 0; i < view.count(); ++i)
        if (view.of(i).exact && view.of(i).status == Status::ranked) names.push_back(view.name(i));
    if (!names.empty())
        sentences.say(listed(names) + (names.size() == 1 ? " is" : " are") +
                      " exact here, without variance: every sample is the answer to rounding");
}

/// How many pairs were not named, of `all`.
void say_more_pairs(Sentences& sentences, std::size_t all, std::size_t named, const char* verdict)
{
    if (all <= named) return;
    const std::size_t more = all - named;
    sentences.say(std::to_string(more) + (more == 1 ? " more pair is " : " more pairs are ") +
                  verdict + " in variance");
}

bool are_tied(const SceneView& view, int i, int j)
{
    const PairReport* p = view.pair(i, j);
    return p && p->verdict == Verdict::tied;
}

/// Ranked strategies of which each is tied with each, in variance: greedily, from the first on.
std::vector<std::vector<int>> tied_groups(const SceneView& view, const SameStrategies& same)
{
    std::vector<std::vector<int>> groups;
    for (const int i : view.in_order()) {
        if (view.of(i).exact || !same.is_first(i)) continue;
        const auto group = std::ranges::find_if(groups, [&](const std::vector<int>& members) {
            return std::ranges::all_of(members, [&](int j) { return are_tied(view, i, j); });
        });
        if (group == groups.end()) groups.push_back({i});
        else group->push_back(i);
    }
    return groups;
}

/// Groups of three and more. Returns the pairs that are told.
std::set<std::pair<int, int>> say_tied_groups(Sentences& sentences, const SceneView& view,
                                              const SameStrategies& same, double margin)
{
    std::set<std::pair<int, int>> told;
    for (const std::vector<int>& group : tied_groups(view, same)) {
        if (group.size() < 3) continue;
        std::vector<std::string> names;
        for (const int i : group) {
            names.push_back(view.name(i));
            for (const int j : group) told.emplace(i, j);
        }
        sentences.say(listed(names) + " are tied in variance, each with each, within " +
                      percent(margin));
    }
    return told;
}

/// Is it for others to speak of these two?
bool are_spoken_for(const SameStrategies& same, const PairReport& p)
{
    return !same.is_first(p.a) || !same.is_first(p.b);
}

void say_ties(Sentences& sentences, const SceneView& view, const SameStrategies& same,
              double margin)
{
    const std::set<std::pair<int, int>> told = say_tied_groups(sentences, view, same, margin);
    std::size_t pairs = 0;
    for (const PairReport& p : view.scene().pairs) {
        if (p.verdict != Verdict::tied || view.of(p.a).exact || told.contains({p.a, p.b}) ||
            are_spoken_for(same, p))
            continue;
        if (++pairs > most_pairs) continue;
        sentences.say(view.name(p.a) + " and " + view.name(p.b) + " are tied in variance within " +
                      percent(margin) + " (ratio " + with_error(p.ratio) + ")");
    }
    say_more_pairs(sentences, pairs, most_pairs, "tied");
}

/// "290 more replicates (19 times as many samples)".
std::string replicates_in_words(const SceneReport& scene, double more)
{
    const std::string text = number(more, 2) + " more replicates";
    return scene.replicates < 1
               ? text
               : text + " (" + number(1 + more / scene.replicates, 2) + " times as many samples)";
}

void say_undecided(Sentences& sentences, const SceneView& view, const SameStrategies& same)
{
    std::size_t undecided = 0;
    for (const PairReport& p : view.scene().pairs) {
        if (p.verdict != Verdict::undecided || are_spoken_for(same, p)) continue;
        if (++undecided > most_undecided) continue;
        sentences.say(view.name(p.a) + " and " + view.name(p.b) +
                      " are undecided in variance (ratio " + with_error(p.ratio) + ")" +
                      (std::isfinite(p.more_replicates)
                           ? ": about " + replicates_in_words(view.scene(), p.more_replicates) +
                                 " would decide"
                           : ""));
    }
    say_more_pairs(sentences, undecided, most_undecided, "undecided");
}

}  // namespace

void say_comparisons(Sentences& sentences, const SceneView& view, const SameStrategies& same,
                     double margin)
{
    say_exact(sentences, view);
    say_ties(sentences, view, same, margin);
    say_undecided(sentences, view, same);
}

}  // namespace mis
