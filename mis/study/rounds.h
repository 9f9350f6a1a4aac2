#pragma once

#include "mis/study/pilot.h"
#include "mis/study/schedule.h"

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace mis {

/// The own samples of a strategy whose variance is not from them: of every point in a round,
/// outside the replicates.
struct SamplesApart {
    int observations = 0;  ///< 0: it takes part in the replicates
    int parts = 1;         ///< StrategyRun::Apart

    bool is_dear() const { return parts > 1; }
};

/// How the rounds of a study go, beside how long they are.
struct RoundOptions {
    std::vector<double> weights;       ///< 1/(μ² + ε²) of every point
    std::vector<double> tile_factors;  ///< [tile]: times the mean number of samples
    std::vector<bool> rests;           ///< [strategy]: takes no part
    std::vector<SamplesApart> apart;   ///< [strategy], or empty
    bool is_even = false;              ///< every tile gets the same number of samples

    SamplesApart apart_of(std::size_t s) const { return apart.empty() ? SamplesApart() : apart[s]; }
};

/// The rounds of samples in which a study's strategies take turns, each time in another order.
class StudyRounds {
public:
    /// runs: of all strategies; null where one is not run. Everything is kept by reference.
    /// after_turn: told how much of the round is done once a strategy has had its turn.
    StudyRounds(const StudyGround& ground, std::span<const std::unique_ptr<StrategyRun>> runs,
                std::function<void(std::size_t strategy, double of_round)> after_turn);

    /// `chunk` observations of every point, in the mean, for every replicate of the plan: in one
    /// round, or in several in which the replicates take turns.
    void take(int chunk, const SamplePlan& plan, const RoundOptions& options);

    std::uint32_t count() const { return count_; }

private:
    void take_round(const Allocation& allocation, int first, int end, int replicates,
                    const RoundOptions& options);

    const StudyGround& ground_;
    std::span<const std::unique_ptr<StrategyRun>> runs_;
    std::function<void(std::size_t, double)> after_turn_;
    std::uint32_t count_ = 0;
};

}  // namespace mis
