#pragma once

#include "mis/report/changes_report.h"
#include "mis/stats/estimate.h"

namespace mis {

/// What a report's interval tells of the logarithm of its figure. The interval's half width is
/// t·se, t ≥ 1.96 of unknown degrees of freedom, which are `dof` or more: half width/1.96 is at
/// least the standard error, and `dof` at most the degrees, so that no test is too sure of itself.
/// se is NaN where no interval is known.
LogEstimate log_of_stored(const Interval& figure, double dof);

/// What one report says of a strategy, as far as another's is compared with it.
struct Reported {
    const StrategyReport& report;
    int replicates;  ///< of the scene
};

/// The change of one figure. An exact strategy has variance 0 and infinite efficiency: the ratio is
/// then 1 if both are exact, else 0 or infinite, and certain.
Change change_of(ChangingFigure figure, const Reported& before, const Reported& after);

/// P of a cost that grew by no more than the share `worse_by`, or of a mean that is the same. 1
/// where the figure is neither (times depend on the threads) or not compared.
double p_of_no_regression(ChangingFigure figure, const Change& change, double worse_by);

}  // namespace mis
