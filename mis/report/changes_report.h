#pragma once

#include "mis/report/report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mis {

/// The figures of a strategy that are compared between two reports.
enum class ChangingFigure { variance, efficiency, seconds_to_1_percent, mean };
inline constexpr std::size_t figures_that_change = 4;

/// As it stands in files.
constexpr const char* name_of(ChangingFigure figure)
{
    constexpr std::array names{"variance", "efficiency", "seconds_to_1_percent", "mean"};
    return names[static_cast<std::size_t>(figure)];
}

/// One figure, before and after.
struct Change {
    double before = std::numeric_limits<double>::quiet_NaN(), after = before;  ///< NaN: not known
    /// Of the logarithm of after/before; for a mean, of the difference in its standard errors. se
    /// is NaN where nothing can be said.
    LogEstimate estimate{std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::quiet_NaN(), 1};
    /// after/before, 95 %; for a mean (after − before)/standard error.
    Interval by{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
                std::numeric_limits<double>::quiet_NaN()};
    bool is_changed = false;     ///< surely, among all that was compared
    bool is_regression = false;  ///< surely worse by more than was asked

    bool is_compared() const { return !std::isnan(estimate.value) && !std::isnan(estimate.se); }
};

/// One strategy of one scene. status: none where it is not in that report.
struct StrategyChange {
    std::string name;
    std::optional<Status> status_before, status_after;
    bool exact_before = false, exact_after = false;
    std::array<Change, figures_that_change> figures;  ///< by ChangingFigure

    const Change& operator[](ChangingFigure f) const
    {
        return figures[static_cast<std::size_t>(f)];
    }
    /// Biased, and was not before.
    bool is_newly_biased() const
    {
        return status_before && status_before != Status::biased && status_after == Status::biased;
    }
    bool is_regression() const
    {
        return is_newly_biased() ||
               std::ranges::any_of(figures, [](const Change& c) { return c.is_regression; });
    }
    /// Any figure, surely, or the status.
    bool is_changed() const
    {
        return status_before != status_after ||
               std::ranges::any_of(figures, [](const Change& c) { return c.is_changed; });
    }
};

/// One scene. file: empty where it is not in that report.
struct SceneChange {
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::string name, file_before, file_after;
    std::size_t before = none, after = none;  ///< its index in either report
    std::vector<std::string> remarks;         ///< sentences: what makes its figures hard to compare
    std::vector<StrategyChange> strategies;   ///< in the order of the first report, then new ones
};

/// What differs between two reports.
struct Changes {
    std::vector<std::string> remarks;  ///< sentences: how the runs themselves differ
    std::vector<SceneChange> scenes;   ///< in the order of the first report, then new ones
    std::size_t comparisons = 0;       ///< figures that are in both reports
    std::size_t changed = 0;           ///< those of them that surely changed
    std::optional<double> worse_by;    ///< as asked for
    double error = 0;                  ///< probability that any verdict of a kind is wrong, at most

    bool has_regression() const
    {
        return worse_by && std::ranges::any_of(scenes, [](const SceneChange& scene) {
                   return std::ranges::any_of(scene.strategies, &StrategyChange::is_regression);
               });
    }
};

}  // namespace mis
