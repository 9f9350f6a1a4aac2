#pragma once

#include <vector>

namespace mis {

/// Some draws of a point that are spread by what the rounds before them have seen.
struct LearningRound {
    int draws = 0;
    double weight = 0;  ///< of their mean in the estimate; of all rounds together 1
};

/// The rounds of so many draws: the last one takes three quarters of them, the one before three
/// quarters of what is left, and so on, down to 4 to 15 draws. The weights are fixed beforehand,
/// ∝ N_t^{3/2} − N_{t−1}^{3/2} of the draws up to each round: nearly the best, by whatever power of
/// what went before the variance of a round falls (Owen and Zhou 2019, "The square root rule for
/// adaptive importance sampling"). Weights that looked at the rounds' own draws would be biased.
/// draws: at least 1.
std::vector<LearningRound> learning_rounds(int draws);

}  // namespace mis
