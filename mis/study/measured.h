#pragma once

#include "mis/study/mean_checks.h"
#include "mis/study/set_up.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace mis {

/// What each strategy of a study came to so far: by its own samples, and by shared directions where
/// there are any and they are known well enough.
class MeasuredStrategies {
public:
    /// Keeps references. has_closed_form: at every point of the figures, proved.
    MeasuredStrategies(const StudyGround& ground, const std::vector<Strategy>& strategies,
                       SetUp& set_up, bool has_closed_form);

    /// Are shared directions far enough to say something?
    bool is_shared() const { return set_up_.shared && set_up_.shared->is_known(); }
    /// Is the variance of that strategy from its own samples?
    bool is_own(std::size_t s) const { return is_own_[s]; }
    /// The strategy's place among those that share directions, where its variance is from these.
    std::optional<std::size_t> shared_place(std::size_t s) const;
    /// No light, or no point that can be lit: every sample is 0, as the mean is.
    bool is_dark() const;

    /// Once some turns are done: by their errors, which are no part of any figure, whose variance
    /// own samples tell. times: how many times as many directions there will be.
    void choose_sources(double times);

    /// Finds all that shared directions say so far, which no reference changes.
    void look();

    /// As of the last look. scale: μ² + ε² of every point.
    StrategyMeasurements of(std::size_t s, const RelativeScale& scale) const;
    /// Its variance, mean over the points, at most: where shared directions say it.
    std::optional<double> shared_variance(std::size_t s) const;

private:
    struct OfShared {
        SharedFigures figures;
        std::vector<MeanCheck> means;
    };
    StrategyMeasurements not_run(std::size_t s) const;
    std::optional<std::size_t> place_of(std::size_t s) const;

    const StudyGround& ground_;
    const std::vector<Strategy>& strategies_;
    SetUp& set_up_;
    bool has_closed_form_, has_chosen_ = false;
    std::vector<bool> is_own_;         ///< [strategy]
    std::vector<OfShared> of_shared_;  ///< [strategy]
};

}  // namespace mis
