#pragma once

#include "mis/scene/scene.h"
#include "mis/strategy/strategy.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mis::cli {

/// What `compare` was asked for: comma lists; nothing where nothing was said.
struct StrategyLists {
    std::optional<std::string> policies, heuristics, techniques, models, strategies;

    /// Is a product of lists asked for, as it is where nothing is?
    bool has_product() const { return !strategies || names_any_list(); }
    bool names_any_list() const { return policies || heuristics || techniques || models; }
};

/// What a command makes of `strata`.
struct StrataRequest {
    int draws = 64;                   ///< of a point, where its name has no number
    std::optional<std::int64_t> spp;  ///< samples of a point, where they are counted
};

/// The same, read: names that are known, and strategies that have a meaning.
struct StrategyRequest {
    std::optional<std::vector<std::string>> policies, heuristics, techniques;
    std::vector<std::string> models;
    std::vector<Strategy> named;  ///< by --strategy
    bool has_product = true, names_any_list = false;
    std::optional<StrataRequest> strata = {};  ///< none: the command has no figures of it
};

/// Throws StrategyError and UsageError for unknown names.
StrategyRequest read_lists(const StrategyLists& lists);

/// What of a scene says which strategies are ranked by default.
struct SceneTraits {
    std::size_t lights = 0;
    bool has_lobes = false;  ///< of a BSDF, beside its diffuse part
};
SceneTraits traits_of(const Scene& scene);

/// The names of a list option, or `otherwise`, each of them known. Throws UsageError.
std::vector<std::string> names_listed(const std::string& option,
                                      const std::optional<std::string>& given,
                                      const std::string& otherwise,
                                      const std::vector<std::string>& known);

/// The strategies to rank, each once, in the order asked for, and those of a product of lists that
/// have no meaning.
struct StrategySelection {
    std::vector<Strategy> strategies;
    std::vector<std::string> left_out;  ///< the reason for each, by name
};

/// Throws UsageError where a strategy cannot do with so many lights.
void check_lights(const Strategy& strategy, std::size_t lights);

/// Every combination of the lists that has a meaning, and the strategies named. In place of a list
/// that was not given stand the names that are ranked by default on such a scene
/// (strategy/names.h). Throws UsageError where nothing is left.
StrategySelection select_strategies(const StrategyRequest& request, const SceneTraits& scene);

}  // namespace mis::cli
