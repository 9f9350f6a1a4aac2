#include "mis/study/rounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mis {
namespace {

/// About `chunk` observations per replicate in the mean, at least two.
Allocation allocation_of(int chunk, const RoundOptions& options)
{
    Allocation allocation;
    for (const double factor : options.tile_factors)
        allocation.push_back(
            options.is_even ? chunk : std::max(2, static_cast<int>(std::lround(factor * chunk))));
    return allocation;
}

}  // namespace

StudyRounds::StudyRounds(const StudyGround& ground,
                         std::span<const std::unique_ptr<StrategyRun>> runs,
                         std::function<void(std::size_t, double)> after_turn)
    : ground_(ground), runs_(runs), after_turn_(std::move(after_turn))
{
}

void StudyRounds::take(int chunk, const SamplePlan& plan, const RoundOptions& options)
{
    const Allocation allocation = allocation_of(chunk, options);
    const int part = plan.replicates / plan.parts;
    for (int first = 0; first < plan.replicates && !ground_.is_stopped(); first += part)
        take_round(allocation, first, first + part, plan.replicates, options);
}

void StudyRounds::take_round(const Allocation& allocation, int first, int end, int replicates,
                             const RoundOptions& options)
{
    const bool is_timed = is_round_timed(count_);
    const std::vector<std::size_t> order = round_order(runs_.size(), ground_.seed, count_++);
    std::size_t done = 0;
    for (const std::size_t s : order) {
        if (ground_.is_stopped()) return;
        if (runs_[s] && !options.rests[s])
            runs_[s]->sample_round({allocation, first, end, replicates, is_timed}, options.weights,
                                   ground_.workspaces, ground_.executor, ground_.stop);
        else if (runs_[s] && is_timed) runs_[s]->miss_round();
        after_turn_(s, static_cast<double>(++done) / static_cast<double>(order.size()));
    }
}

}  // namespace mis
