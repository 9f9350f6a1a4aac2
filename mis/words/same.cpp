#include "mis/words/same.h"

#include "mis/stats/decision.h"
#include "mis/words/numbers.h"

#include <algorithm>
#include <set>
#include <string>

namespace mis {
namespace {

/// The strategy by another policy; of one light, where directions are priced alike by either.
Strategy with_policy(Strategy s, const std::string& policy, bool is_one_light)
{
    s.policy = policy;
    if (is_one_light && s.technique == "union") s.technique = "cone";
    return s;
}

bool are_same_by_construction(const SceneView& view, int i, int j)
{
    const Strategy &a = view.of(i).strategy, &b = view.of(j).strategy;
    return view.scene().lights == 1 && a.chooses_light() && b.chooses_light() &&
           with_policy(a, "", true) == with_policy(b, "", true);
}

bool is_ranked(const SceneView& view, int i) { return view.of(i).status == Status::ranked; }

std::vector<std::string> ranked_policies(const SceneView& view)
{
    std::vector<std::string> policies;
    for (int i = 0; i < view.count(); ++i) {
        const std::string& policy = view.of(i).strategy.policy;
        if (is_ranked(view, i) && !policy.empty() && std::ranges::count(policies, policy) == 0)
            policies.push_back(policy);
    }
    return policies;
}

int find(const SceneView& view, const Strategy& strategy)
{
    for (int i = 0; i < view.count(); ++i)
        if (is_ranked(view, i) && view.of(i).strategy == strategy) return i;
    return -1;
}

/// Are all strategies of one policy the same as those of the other, wherever both are ranked?
bool are_policies_same(const SceneView& view, const SameStrategies& same, const std::string& p,
                       const std::string& q)
{
    int found = 0;
    for (int i = 0; i < view.count(); ++i) {
        if (!is_ranked(view, i) || view.of(i).strategy.policy != p) continue;
        const int j = find(view, with_policy(view.of(i).strategy, q, false));
        if (j < 0) continue;
        if (!same.are_same(i, j)) return false;
        ++found;
    }
    return found > 0;
}

/// Says which policies are; by strategy, the first of those that this speaks of together.
void say_same_policies(Sentences& sentences, const SceneView& view, const SameStrategies& same,
                       std::set<int>& told)
{
    std::vector<std::string> left = ranked_policies(view);
    while (!left.empty()) {
        std::vector<std::string> group{left.front()}, others;
        for (auto q = left.begin() + 1; q != left.end(); ++q)
            (are_policies_same(view, same, group.front(), *q) ? group : others).push_back(*q);
        left = std::move(others);
        if (group.size() < 2) continue;
        sentences.say((view.scene().lights == 1 ? "With one light, the policies "
                                                : "On this scene, the policies ") +
                      listed(group) + " are the same: they draw the same samples");
        for (int i = 0; i < view.count(); ++i)
            if (std::ranges::count(group, view.of(i).strategy.policy) > 0) told.insert(i);
    }
}

}  // namespace

SameStrategies::SameStrategies(const SceneView& view)
{
    for (int i = 0; i < view.count(); ++i) {
        first_.push_back(i);
        for (int j = 0; j < i && is_ranked(view, i); ++j)
            if (is_ranked(view, j) && (are_same_by_construction(view, i, j) ||
                                       have_same_samples(view.of(i), view.of(j)))) {
                first_.back() = first_of(j);
                break;
            }
    }
}

void say_the_same(Sentences& sentences, const SceneView& view, const SameStrategies& same)
{
    std::set<int> told;
    say_same_policies(sentences, view, same, told);
    for (int i = 0; i < view.count(); ++i) {
        std::vector<std::string> names;
        for (int j = i; j < view.count(); ++j)
            if (same.first_of(j) == i && (j == i || !told.contains(j)))
                names.push_back(view.name(j));
        if (names.size() > 1)
            sentences.say(listed(names) + " are the same here: they draw the same samples");
    }
}

}  // namespace mis
