#pragma once

#include "mis/compare/change.h"
#include "mis/compare/report.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace mis {

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
    bool is_newly_biased() const;
    bool is_regression() const;
    bool is_changed() const;  ///< any figure, surely, or the status
};

/// One scene. file: empty where it is not in that report.
struct SceneChange {
    std::string name, file_before, file_after;
    std::vector<std::string> remarks;        ///< sentences: what makes its figures hard to compare
    std::vector<StrategyChange> strategies;  ///< in the order of the first report, then new ones
};

/// What differs between two reports.
struct Changes {
    std::vector<std::string> remarks;  ///< sentences: how the runs themselves differ
    std::vector<SceneChange> scenes;   ///< in the order of the first report, then new ones
    std::size_t comparisons = 0;       ///< figures that are in both reports
    std::size_t changed = 0;           ///< those of them that surely changed
    std::optional<double> worse_by;    ///< as asked for
    double error = 0;                  ///< probability that any verdict of a kind is wrong, at most

    bool has_regression() const;
};

struct ChangesOptions {
    /// A regression is a cost (variance, or 1/efficiency) that surely grew by more than this share,
    /// a mean that changed, or a bias that is new. None: regressions are not looked for.
    std::optional<double> worse_by;
    double error = 0.05;
};

/// Compares two reports figure by figure. Scenes match by name and file; what is left, by name
/// alone (the k-th with the k-th); strategies match by name. Figures are compared where the
/// strategy is ranked in both; means, where both runs looked at the same points of the same scene;
/// efficiencies, where both are for as many samples per point. A figure is changed where
/// decide() (pairs.h) finds its ratio apart from 1, over all figures of all scenes together.
Changes changes_between(const Report& before, const Report& after,
                        const ChangesOptions& options = {});

}  // namespace mis
