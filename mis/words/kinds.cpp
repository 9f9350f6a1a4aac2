#include "mis/words/kinds.h"

#include "mis/words/numbers.h"

#include <vector>

namespace mis {

std::string kind_of_trouble(std::span<const std::string> names, const char* what,
                            const KindWords& words)
{
    constexpr std::size_t most_named = 3;
    if (names.size() == 1) return names[0] + " " + words.one + words.more;
    std::vector<std::string> shown(names.begin(), names.end());
    if (names.size() > most_named + 1) {
        shown.resize(most_named);
        shown.push_back(std::to_string(names.size() - most_named) + " more");
    }
    return many(names.size(), what) + " " + words.many + ": " + listed(shown) + words.more;
}

}  // namespace mis
