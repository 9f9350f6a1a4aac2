#include "mis/study/stopping.h"

#include "mis/stats/rank.h"

#include <algorithm>

namespace mis {
namespace {

/// Not resolved yet, but within the time that is left if all goes on as before.
bool is_worth_waiting_for(const StrategyReport& strategy, const StudyGoal& goal, double elapsed)
{
    if (strategy.status != Status::not_resolved) return false;
    // Shared directions resolve every variance in the end.
    return strategy.variance_from == VarianceSource::shared ||
           1.5 * strategy.resolving_factor * elapsed < goal.budget();
}

bool are_all_known(const SceneReport& so_far, const StudyGoal& goal, double elapsed)
{
    bool any = false;
    for (const StrategyReport& s : so_far.strategies) {
        if (s.status != Status::ranked) continue;
        any = true;
        if (!is_known_to(*goal.error, s.variance)) return false;
    }
    return any || elapsed > goal.default_seconds;  // else without end
}

/// Would more of its own samples tell what is asked: which strategy is best, and every variance?
bool is_needed(const StrategyReport& s, bool is_decided, const StudyGoal& goal, double elapsed)
{
    const bool tell_its_variance = s.variance_from == VarianceSource::own;
    if (s.status != Status::ranked)
        return tell_its_variance && is_worth_waiting_for(s, goal, elapsed);
    return (s.may_be_best && !is_decided) ||
           (tell_its_variance && !is_known_to(variance_is_known, s.variance));
}

}  // namespace

bool is_enough(const SceneReport& so_far, const StudyGoal& goal, double elapsed)
{
    if (goal.stops_when_settled())
        return so_far.settled &&
               std::ranges::none_of(so_far.strategies, [&](const StrategyReport& s) {
                   return is_worth_waiting_for(s, goal, elapsed);
               });
    return goal.error && are_all_known(so_far, goal, elapsed);
}

std::vector<bool> resting(const SceneReport& so_far, const StudyGoal& goal, double elapsed)
{
    std::vector<bool> rests;
    for (const StrategyReport& s : so_far.strategies)
        rests.push_back(!is_needed(s, so_far.decided, goal, elapsed));
    if (std::ranges::find(rests, false) == rests.end()) rests.assign(rests.size(), false);
    return rests;
}

}  // namespace mis
