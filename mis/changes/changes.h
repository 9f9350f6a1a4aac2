#pragma once

#include "mis/report/changes_report.h"

#include <optional>

namespace mis {

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
/// decide() (stats/pairs.h) finds its ratio apart from 1, over all figures of all scenes together.
/// Remarks are left to words/changes_remarks.h.
Changes changes_between(const Report& before, const Report& after,
                        const ChangesOptions& options = {});

}  // namespace mis
