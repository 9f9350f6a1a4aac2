#pragma once

#include "mis/strategy/strategy.h"

#include <optional>
#include <string>
#include <vector>

namespace mis::cli {

/// What `compare` was asked for: comma lists; nothing where nothing was said.
struct StrategyLists {
    std::optional<std::string> policies, heuristics, techniques, models, strategies;

    /// Is a product of lists asked for, as it is where nothing is?
    bool has_product() const
    {
        return !strategies || policies || heuristics || techniques || models;
    }
};

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

/// Every combination of the lists that has a meaning, and the strategies named. Nothing said: the
/// classic policies × light, balance, power, and brdf. Throws StrategyError and UsageError for
/// unknown names, or where nothing is left.
StrategySelection select_strategies(const StrategyLists& lists);

}  // namespace mis::cli
