#pragma once

#include "mis/stats/estimate.h"
#include "mis/study/pilot.h"
#include "mis/study/shared_samples.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace mis {

/// The variances of a study's strategies at all of its points from directions that all share, taken
/// in turns. Each turn is a replicate of every strategy's figures: the same directions for all.
/// Where there are many turns, two make one, and later ones are twice as long.
class SharedTurns {
public:
    /// weights: 1/(μ² + ε²) of every point. Keeps a reference to the ground's scene and points.
    SharedTurns(const StudyGround& ground, std::span<const double> weights,
                std::span<const Strategy> strategies, const SharedCounts& counts,
                int rounds_of_turn = 1);

    /// CPU seconds of one round at all points, from a few of them. Throws Stopped.
    static double round_seconds(const StudyGround& ground, std::span<const Strategy> strategies,
                                const SharedCounts& counts);

    /// Finds the weights anew, from the directions so far. The turns so far are no replicates of
    /// relative variances any more, though their directions count in the figures.
    void weigh_again();

    /// The next turn, at every point. False where it was stopped: then it is no replicate.
    bool take(const StudyGround& ground);
    /// Wall seconds of the last one.
    double last_seconds() const { return last_seconds_; }

    /// Replicates so far.
    std::size_t count() const { return turns_.size(); }
    /// Directions at each point.
    std::uint64_t directions() const;
    /// With those of the next turn, and of the first two that it takes to know an error.
    std::uint64_t directions_after_next() const;
    std::uint64_t fewest_directions() const { return (1 + 2 * rounds_of_turn_) * of_round(); }
    /// At least two turns are done, so that all has an error.
    bool is_known() const { return turns_.size() >= 2; }

    // Of one strategy, by its place in the list. Precondition: is_known().

    SharedFigures figures(std::size_t strategy) const;
    /// Variance of one sample at a figures' point.
    ValueAndError at(std::size_t strategy, std::size_t point) const
    {
        return of_figures_.at(strategy, point);
    }
    /// Its mean over the points, each times its weight; no weights: 1.
    ValueAndError mean(std::size_t strategy, std::span<const double> weights = {}) const
    {
        return of_figures_.mean(strategy, weights);
    }
    /// Its relative standard error, were so many times as many turns taken.
    double relative_error(std::size_t strategy, double times) const;
    /// Direct radiance's luminance, over the image and each of its regions: the right mean.
    std::vector<MeanCheck> right_means() const;

private:
    using Table = std::vector<std::vector<double>>;
    /// One turn, in the mean over its rounds.
    struct Turn {
        Table variance, relative;       ///< [strategy][region]: its part of either
        std::vector<double> luminance;  ///< [region]: its part of the mean
    };
    std::uint64_t of_round() const
    {
        return shared_groups * static_cast<std::uint64_t>(counts_.all());
    }
    bool is_begun() const { return of_figures_.all_rounds() > 0; }
    Turn last_turn() const;
    void merge_pairs();
    double epsilon() const;
    void add_relative(SharedFigures& figures, std::size_t strategy) const;
    RegionSums relative_of(std::size_t strategy) const;
    RegionSums variances_of(std::size_t strategy) const;

    const StudyPoints* points_;
    std::vector<double> weights_;
    std::size_t strategies_;
    SharedCounts counts_;
    int rounds_of_turn_;
    SharedSamples of_figures_, of_probes_;
    std::vector<Turn> turns_;
    std::size_t weighed_from_ = 0;  ///< the first turn that has today's weights
    double last_seconds_ = 0;
};

}  // namespace mis
