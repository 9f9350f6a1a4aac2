#include "mis/changes/changes.h"

#include "mis/changes/change.h"
#include "mis/stats/pairs.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace mis {
namespace {

constexpr std::size_t none = SceneChange::none;

/// Matches the k-th of `before` that has a key with the k-th of `after` that has it. Skips what is
/// matched already, and empty keys.
template <class Key>
void match(const std::vector<Key>& before, const std::vector<Key>& after,
           std::vector<std::size_t>& partner, std::vector<bool>& taken)
{
    std::map<Key, std::vector<std::size_t>> free;  // last first
    for (std::size_t i = after.size(); i-- > 0;)
        if (!taken[i] && after[i] != Key{}) free[after[i]].push_back(i);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const auto found = partner[i] == none ? free.find(before[i]) : free.end();
        if (found == free.end() || found->second.empty()) continue;
        partner[i] = found->second.back();
        taken[partner[i]] = true;
        found->second.pop_back();
    }
}

template <class Item, class Name> auto keys_of(const std::vector<Item>& items, const Name& name)
{
    std::vector<decltype(name(items.front()))> keys;
    for (const Item& item : items) keys.push_back(name(item));
    return keys;
}

/// Which of `after` each of `before` is, or none; and which of `after` are anyone's.
struct Partners {
    std::vector<std::size_t> of_before;
    std::vector<bool> taken;
};

Partners matched_scenes(const std::vector<SceneReport>& before,
                        const std::vector<SceneReport>& after)
{
    Partners p{std::vector<std::size_t>(before.size(), none),
               std::vector<bool>(after.size(), false)};
    const auto whole = [](const SceneReport& s) { return std::pair(s.name, s.file); };
    const auto name = [](const SceneReport& s) { return s.name; };
    match(keys_of(before, whole), keys_of(after, whole), p.of_before, p.taken);
    match(keys_of(before, name), keys_of(after, name), p.of_before, p.taken);
    return p;
}

Partners matched_strategies(const SceneReport& before, const SceneReport& after)
{
    Partners p{std::vector<std::size_t>(before.strategies.size(), none),
               std::vector<bool>(after.strategies.size(), false)};
    const auto name = [](const StrategyReport& s) { return name_of(s.strategy); };
    match(keys_of(before.strategies, name), keys_of(after.strategies, name), p.of_before, p.taken);
    return p;
}

/// A strategy of either report alone, or of both; null where it is not there.
StrategyChange strategy_change(const StrategyReport* before, const StrategyReport* after)
{
    StrategyChange change;
    change.name = name_of((before != nullptr ? before : after)->strategy);
    if (before != nullptr)
        change.status_before = before->status, change.exact_before = before->exact;
    if (after != nullptr) change.status_after = after->status, change.exact_after = after->exact;
    return change;
}

/// Which figures mean the same in both.
struct Comparable {
    bool means, efficiencies;
};

StrategyChange strategy_change(const Reported& before, const Reported& after,
                               const Comparable& comparable)
{
    StrategyChange change = strategy_change(&before.report, &after.report);
    if (before.report.status != Status::ranked || after.report.status != Status::ranked)
        return change;
    for (std::size_t i = 0; i < figures_that_change; ++i) {
        const auto figure = static_cast<ChangingFigure>(i);
        if ((figure == ChangingFigure::mean && !comparable.means) ||
            (figure == ChangingFigure::efficiency && !comparable.efficiencies))
            continue;
        change.figures[i] = change_of(figure, before, after);
    }
    return change;
}

/// Are both reports' figures of the same points of the same scene, as far as they tell?
bool same_points(const SceneReport& before, const SceneReport& after)
{
    const auto facts = [](const SceneReport& s) {
        return std::tuple(s.lights, s.surfaces, s.triangles, s.width, s.height, s.shading_points);
    };
    return facts(before) == facts(after);
}

SceneChange scene_change(const SceneReport& before, const SceneReport& after, bool same_at)
{
    SceneChange change{.name = before.name, .file_before = before.file, .file_after = after.file};
    const Comparable comparable{.means = same_points(before, after), .efficiencies = same_at};
    const Partners partners = matched_strategies(before, after);
    for (std::size_t i = 0; i < before.strategies.size(); ++i) {
        const std::size_t partner = partners.of_before[i];
        change.strategies.push_back(
            partner == none ? strategy_change(&before.strategies[i], nullptr)
                            : strategy_change(Reported{before.strategies[i], before.replicates},
                                              Reported{after.strategies[partner], after.replicates},
                                              comparable));
    }
    for (std::size_t i = 0; i < after.strategies.size(); ++i)
        if (!partners.taken[i])
            change.strategies.push_back(strategy_change(nullptr, &after.strategies[i]));
    return change;
}

/// Every figure that is in both reports.
struct Compared {
    ChangingFigure figure;
    Change* change;
};
std::vector<Compared> compared(Changes& changes)
{
    std::vector<Compared> all;
    for (SceneChange& scene : changes.scenes)
        for (StrategyChange& strategy : scene.strategies)
            for (std::size_t i = 0; i < figures_that_change; ++i)
                if (strategy.figures[i].is_compared())
                    all.push_back({static_cast<ChangingFigure>(i), &strategy.figures[i]});
    return all;
}

void find_changes(Changes& changes, const std::vector<Compared>& all)
{
    std::vector<Comparison> family;
    for (const Compared& each : all) family.push_back({.log_ratio = each.change->estimate});
    decide(family, 0, changes.error);
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].change->is_changed = family[i].verdict == Verdict::apart;
    changes.comparisons = all.size();
    changes.changed = static_cast<std::size_t>(std::count_if(
        all.begin(), all.end(), [](const Compared& each) { return each.change->is_changed; }));
}

/// A regression is also a change: so the two never contradict each other.
void find_regressions(double worse_by, double error, std::vector<Compared> all)
{
    std::erase_if(all, [](const Compared& each) {
        return each.figure == ChangingFigure::seconds_to_1_percent;
    });
    std::vector<double> p;
    for (const Compared& each : all)
        p.push_back(p_of_no_regression(each.figure, *each.change, worse_by));
    const std::vector<bool> worse = holm(p, error);
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i].change->is_regression = worse[i] && all[i].change->is_changed;
}

}  // namespace

Changes changes_between(const Report& before, const Report& after, const ChangesOptions& options)
{
    Changes changes{.worse_by = options.worse_by, .error = options.error};
    const Partners partners = matched_scenes(before.scenes, after.scenes);
    for (std::size_t i = 0; i < before.scenes.size(); ++i) {
        const SceneReport& scene = before.scenes[i];
        const std::size_t partner = partners.of_before[i];
        changes.scenes.push_back(
            partner == none ? SceneChange{.name = scene.name, .file_before = scene.file}
                            : scene_change(scene, after.scenes[partner], before.at == after.at));
        changes.scenes.back().before = i;
        changes.scenes.back().after = partner;
    }
    for (std::size_t i = 0; i < after.scenes.size(); ++i)
        if (!partners.taken[i])
            changes.scenes.push_back(
                {.name = after.scenes[i].name, .file_after = after.scenes[i].file, .after = i});
    const std::vector<Compared> all = compared(changes);
    find_changes(changes, all);
    if (options.worse_by) find_regressions(*options.worse_by, options.error, all);
    return changes;
}

}  // namespace mis
