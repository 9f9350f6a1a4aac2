#include "mis/learn/rounds.h"

#include <algorithm>
#include <cmath>

namespace mis {

std::vector<LearningRound> learning_rounds(int draws)
{
    constexpr int growth = 4, fewest = 4;
    std::vector<int> totals{draws};
    while (totals.back() / growth >= fewest) totals.push_back(totals.back() / growth);
    std::ranges::reverse(totals);
    std::vector<LearningRound> rounds;
    int before = 0;
    const auto share = [&](int total) { return std::pow(double(total) / draws, 1.5); };
    for (const int total : totals) {
        rounds.push_back({total - before, share(total) - share(before)});
        before = total;
    }
    return rounds;
}

}  // namespace mis
