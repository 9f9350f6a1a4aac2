#include "mis/cli/strategy_list.h"

#include "mis/cli/options.h"
#include "mis/strategy/names.h"

#include <algorithm>

namespace mis::cli {

namespace {

constexpr const char* default_policies = "uniform,power,solid-angle,radiant-solid-angle,all";
constexpr const char* default_heuristics = "light,balance,power,brdf";

std::vector<std::string> names_of(const std::vector<Choosable>& list)
{
    std::vector<std::string> names;
    for (const Choosable& c : list) names.push_back(c.name);
    return names;
}

void add(StrategySelection& selection, const Strategy& strategy)
{
    if (std::find(selection.strategies.begin(), selection.strategies.end(), strategy) ==
        selection.strategies.end())
        selection.strategies.push_back(strategy);
}

/// Which policies are not among these, and how to have them.
std::string policies_beside(const std::vector<std::string>& policies)
{
    std::string others;
    for (const std::string& name : names_of(policy_names()))
        if (std::find(policies.begin(), policies.end(), name) == policies.end())
            others += (others.empty() ? "" : ",") + name;
    return "the policies that know most of a light; --policy " + others + " ranks them";
}

/// Policies × heuristics × techniques × models; brdf among the heuristics stands for the strategy
/// of that name.
void add_product(StrategySelection& selection, const StrategyLists& lists)
{
    std::vector<std::string> heuristics_known = names_of(heuristic_names());
    heuristics_known.emplace_back("brdf");
    const auto policies =
        names_listed("--policy", lists.policies, default_policies, names_of(policy_names()));
    const auto heuristics =
        names_listed("--heuristic", lists.heuristics, default_heuristics, heuristics_known);
    const auto techniques =
        names_listed("--technique", lists.techniques, "cone", names_of(technique_names()));
    const auto models = names_listed("--model", lists.models, "multi", {"multi", "one-sample"});
    for (const std::string& model : models)
        for (const std::string& technique : techniques)
            for (const std::string& policy : policies)
                for (const std::string& heuristic : heuristics) {
                    if (heuristic == "brdf") continue;
                    Strategy s{.policy = policy, .heuristic = heuristic, .technique = technique};
                    if (model == "one-sample") s.model = Model::one_sample;
                    if (heuristic == "light" && s.model == Model::multi) s.counts = {1, 0};
                    try {
                        add(selection, checked(s));
                    } catch (const StrategyError& error) {
                        selection.left_out.emplace_back(error.what());
                    }
                }
    if (std::find(heuristics.begin(), heuristics.end(), "brdf") != heuristics.end())
        add(selection, parse_strategy("brdf"));
    if (!lists.policies) selection.left_out.push_back(policies_beside(policies));
}

}  // namespace

std::vector<std::string> names_listed(const std::string& option,
                                      const std::optional<std::string>& given,
                                      const std::string& otherwise,
                                      const std::vector<std::string>& known)
{
    const std::vector<std::string> names = split_list(given.value_or(otherwise), option);
    const std::vector<std::string_view> views(known.begin(), known.end());
    for (const std::string& name : names)
        if (std::find(known.begin(), known.end(), name) == known.end())
            refuse_name(option + ": found", name, views);
    return names;
}

StrategySelection select_strategies(const StrategyLists& lists)
{
    StrategySelection selection;
    if (lists.has_product()) add_product(selection, lists);
    if (lists.strategies)
        for (const std::string& name : split_list(*lists.strategies, "--strategy"))
            add(selection, parse_strategy(name));
    if (selection.strategies.empty())
        throw UsageError("no strategy is left:\n    " + selection.left_out.front());
    return selection;
}

}  // namespace mis::cli
