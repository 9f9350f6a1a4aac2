#include "mis/study/stopping.h"

#include <algorithm>

namespace mis {
namespace {

/// Not resolved yet, but within the time that is left if all goes on as before.
bool is_worth_waiting_for(const StrategyReport& strategy, const StudyGoal& goal, double elapsed)
{
    return strategy.status == Status::not_resolved &&
           1.5 * strategy.resolving_factor * elapsed < goal.budget();
}

bool is_known_to(double error, const Interval& variance)
{
    return !(variance.value > 0) || variance.high - variance.low <= 2 * error * variance.value;
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

bool do_all_rest(const std::vector<bool>& rests)
{
    return std::find(rests.begin(), rests.end(), false) == rests.end();
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
    std::vector<bool> rests(so_far.strategies.size(), true);
    for (const PairReport& pair : so_far.pairs)
        if (pair.verdict == Verdict::undecided)
            rests[static_cast<std::size_t>(pair.a)] = rests[static_cast<std::size_t>(pair.b)] =
                false;
    if (do_all_rest(rests))
        for (std::size_t s = 0; s < rests.size(); ++s)
            rests[s] = !is_worth_waiting_for(so_far.strategies[s], goal, elapsed);
    if (do_all_rest(rests)) rests.assign(rests.size(), false);
    return rests;
}

}  // namespace mis
