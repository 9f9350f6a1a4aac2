#include "mis/cli/strategy_list.h"

#include "mis/cli/options.h"
#include "mis/effects/effects.h"
#include "mis/scene/nearest_name.h"
#include "mis/strategy/names.h"

#include <fmt/format.h>

#include <algorithm>

namespace mis::cli {

namespace {

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

/// The policies that are not among these, as --policy takes them.
std::string policies_beside(const std::vector<std::string>& policies)
{
    std::string others;
    for (const std::string& name : names_of(policy_names()))
        if (std::find(policies.begin(), policies.end(), name) == policies.end())
            others += (others.empty() ? "" : ",") + name;
    return others;
}

/// A light draw by itself has no BSDF draw; whether that has a meaning is not asked.
Strategy combined(const std::string& model, const std::string& technique, const std::string& policy,
                  const std::string& heuristic)
{
    Strategy s{.policy = policy, .heuristic = heuristic, .technique = technique};
    if (model == "one-sample") s.model = Model::one_sample;
    if (heuristic == "light" && s.model == Model::multi) s.counts = {1, 0};
    return s;
}

/// The lists of a request, and what stands in place of those that were not given.
struct Product {
    std::vector<std::string> policies, heuristics, techniques, models;
    std::vector<std::string> whole;  ///< strategies beside these
};

Product product_of(const StrategyRequest& request, const SceneTraits& scene)
{
    const auto ranked = [&](const std::vector<Choosable>& list) {
        return ranked_by_default(list, scene.lights, scene.has_lobes);
    };
    Product product;
    product.policies = request.policies.value_or(ranked(policy_names()));
    product.models = request.models;
    product.techniques = request.techniques.value_or(std::vector{Strategy().technique});
    if (request.heuristics) {
        product.heuristics = *request.heuristics;
        if (std::erase(product.heuristics, "brdf") > 0) product.whole = {"brdf"};
    } else {
        product.heuristics = ranked(heuristic_names());
        for (const std::string& name : strategies_ranked_by_default(scene.lights, scene.has_lobes))
            if (!parse_strategy(name).chooses_light() || !request.names_any_list)
                product.whole.push_back(name);
    }
    return product;
}

/// Policies × heuristics × techniques × models; brdf among the heuristics stands for the strategy
/// of that name.
void add_product(StrategySelection& selection, const StrategyRequest& request,
                 const SceneTraits& scene)
{
    const Product product = product_of(request, scene);
    for (const std::string& model : product.models)
        for (const std::string& technique : product.techniques)
            for (const std::string& policy : product.policies)
                for (const std::string& heuristic : product.heuristics) try {
                        add(selection, checked(combined(model, technique, policy, heuristic)));
                    } catch (const StrategyError& error) {
                        selection.left_out.emplace_back(error.what());
                    }
    for (const std::string& name : product.whole) add(selection, parse_strategy(name));
    if (const std::string others = policies_beside(product.policies);
        !request.policies && !others.empty())
        selection.left_out.push_back("not ranked by default here; add --policy " + others);
}

/// What keeps a command from `strata` on a scene; empty: nothing.
std::string obstacle(const Strategy& strata, const std::optional<StrataRequest>& request,
                     const SceneTraits& scene)
{
    const int each = samples_together(strata);
    if (!request)
        return fmt::format(
            "{}: its variance depends on how many draws it has, which this command "
            "has no figures for; `mis compare` has",
            name_of(strata));
    if (scene.lights > most_strata_lights) return too_many_lights(strata, scene.lights);
    if (request->spp && (*request->spp < 4 * std::int64_t{each} || *request->spp % each != 0))
        return fmt::format(
            "{}: its {} samples come together, so --spp is a multiple of {}, and at "
            "least {}; found {}",
            name_of(strata), each, each, 4 * std::int64_t{each}, *request->spp);
    return "";
}

/// Adds `strata`, with its number of draws.
void add_strata(StrategySelection& selection, Strategy strategy, const StrategyRequest& request,
                const SceneTraits& scene, bool is_named)
{
    if (strategy.counts[0] == 0 && request.strata) strategy = strata(request.strata->draws);
    const std::string reason = obstacle(strategy, request.strata, scene);
    if (reason.empty()) add(selection, strategy);
    else if (is_named) throw UsageError("strategy " + reason);
    else selection.left_out.push_back(reason);
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

StrategyRequest read_lists(const StrategyLists& lists)
{
    StrategyRequest request{.has_product = lists.has_product(),
                            .names_any_list = lists.names_any_list()};
    std::vector<std::string> heuristics = names_of(heuristic_names());
    heuristics.emplace_back("brdf");
    const auto read = [](const char* option, const std::optional<std::string>& list,
                         const std::vector<std::string>& known) {
        return list ? std::optional(names_listed(option, list, "", known)) : std::nullopt;
    };
    request.policies = read("--policy", lists.policies, names_of(policy_names()));
    request.heuristics = read("--heuristic", lists.heuristics, heuristics);
    request.techniques = read("--technique", lists.techniques, names_of(technique_names()));
    request.models = names_listed("--model", lists.models, "multi", {"multi", "one-sample"});
    if (lists.strategies)
        for (const std::string& name : split_list(*lists.strategies, "--strategy"))
            request.named.push_back(parse_strategy(name));
    return request;
}

void check_lights(const Strategy& strategy, std::size_t lights)
{
    if (strategy.model == Model::strata && lights > most_strata_lights)
        throw UsageError("strategy " + too_many_lights(strategy, lights));
}

SceneTraits traits_of(const Scene& scene) { return {scene.lights.size(), has_lobes(scene)}; }

StrategySelection select_strategies(const StrategyRequest& request, const SceneTraits& scene)
{
    StrategySelection selection;
    if (request.has_product) add_product(selection, request, scene);
    if (request.has_product && !request.names_any_list && request.strata)
        add_strata(selection, strata(0), request, scene, false);
    for (const Strategy& strategy : request.named)
        if (strategy.model == Model::strata) add_strata(selection, strategy, request, scene, true);
        else add(selection, strategy);
    if (selection.strategies.empty())
        throw UsageError("no strategy is left:\n    " + selection.left_out.front());
    return selection;
}

}  // namespace mis::cli
