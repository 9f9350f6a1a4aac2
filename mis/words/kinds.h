#pragma once

#include <span>
#include <string>

namespace mis {

/// How a kind of trouble is said of one and of many: "is not resolved", "are not resolved".
struct KindWords {
    const char *one, *many;
    const char* more = "";  ///< what follows the names
};

/// "brdf is not resolved", "7 strategies are not resolved: a, b, c and 4 more", without a stop.
/// names: at least one. what: "strategy".
std::string kind_of_trouble(std::span<const std::string> names, const char* what,
                            const KindWords& words);

}  // namespace mis
