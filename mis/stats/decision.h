#pragma once

#include "mis/report/strategy_report.h"
#include "mis/stats/pairs.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace mis {

/// Which strategy to use is decided once the leader is at most this share behind every other.
inline constexpr double most_behind = 0.05;

/// What is known of one strategy against the best of its family.
struct Standing {
    bool may_be_best = false;
    double behind_at_most = 0;  ///< share, ≥ 0; infinite where nothing bounds it
};

/// Which strategy to use, and how sure that is.
struct Decision {
    int leader = -1;          ///< −1: there is none to choose from
    bool is_decided = false;  ///< the leader is at most most_behind behind every other
    /// About how many times as many further samples and timed rounds would decide: 0 if it is
    /// decided, NaN where no error is known.
    double more = 0;
    std::vector<Standing> of;  ///< [strategy]; of those in the family
};

/// The family of all that are compared, in one figure that is the better the less it is.
struct Contenders {
    std::span<const int> members;         ///< strategies, in the order they were asked for
    std::span<const Comparison> pairs;    ///< each two of them; more do no harm
    std::size_t strategies = 0;           ///< that members are indices of
    double error = 0.05;                  ///< probability that anything Standing says is wrong
    std::span<const Standing> earlier{};  ///< of the same members at earlier looks; still holds
    /// Is it the clock alone that can tell these two? Its noise must not choose between them.
    std::function<bool(int, int)> are_alike = [](int, int) { return false; };
};

/// Multiple comparisons with the best (Hsu 1981, 1996; docs/theory.md §15): all standings hold
/// together, with a probability of 1 − error, so that they hold for a leader that the data chose.
/// The leader has the least figure of those that may be best; or it is the first that was asked for
/// of those that are like it, and may be best, and are not most_behind behind it in the figure.
Decision decide_best(const Contenders& among);

/// Are all samples of the two the same, as where every policy chooses the same light? Their figures
/// are, to the last bit. Exact ones are not asked.
bool have_same_samples(const StrategyReport& a, const StrategyReport& b);

/// Is it known to ± this share, by half its 95 % interval? What is exactly 0 is.
bool is_known_to(double error, const Interval& figure);

}  // namespace mis
