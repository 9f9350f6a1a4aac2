#pragma once

#include "mis/compare/estimate.h"
#include "mis/compare/report.h"

#include <array>
#include <cstddef>
#include <limits>

namespace mis {

/// The figures of a strategy that are compared between two reports.
enum class ChangingFigure { variance, efficiency, seconds_to_1_percent, mean };
inline constexpr std::size_t figures_that_change = 4;

/// The keys of the report: "variance", "efficiency", "seconds_to_1_percent", "mean".
const char* name_of(ChangingFigure figure);

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

    bool is_compared() const;
};

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
