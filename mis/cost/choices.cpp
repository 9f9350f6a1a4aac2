#include "mis/cost/choices.h"

#include <algorithm>

namespace mis {

std::vector<CostChoice> twins_of(std::span<const Strategy> by_time)
{
    std::vector<CostChoice> twins;
    if (!by_time.empty()) twins.push_back({by_time.front(), Precision::in_double});
    const auto mixing = std::find_if(by_time.begin(), by_time.end(), [](const Strategy& s) {
        return s.chooses_light() && s.heuristic != "light" && s.model == Model::multi;
    });
    if (mixing == by_time.end()) return twins;
    Strategy more = *mixing;
    more.counts = {4, 1};
    twins.push_back({more, Precision::in_float});
    return twins;
}

}  // namespace mis
