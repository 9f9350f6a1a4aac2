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
    std::vector<std::size_t> order = round_order(runs_.size(), ground_.seed, count_);
    // What is dear must not keep others from their turn.
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t s) { return !options.apart_of(s).is_dear(); });
    const std::optional<std::uint32_t> number =
        is_round_timed(count_) ? std::optional(count_) : std::nullopt;
    ++count_;
    std::size_t done = 0;
    for (const std::size_t s : order) {
        if (ground_.is_stopped()) return;
        if (runs_[s] && !options.rests[s]) {
            const SamplesApart apart = options.apart_of(s);
            if (apart.observations > 0)
                runs_[s]->sample_apart({apart.observations, number, apart.parts},
                                       ground_.workspaces, ground_.executor, ground_.stop);
            else
                runs_[s]->sample_round({allocation, first, end, replicates, number},
                                       options.weights, ground_.workspaces, ground_.executor,
                                       ground_.stop);
        }
        after_turn_(s, static_cast<double>(++done) / static_cast<double>(order.size()));
    }
}

}  // namespace mis
