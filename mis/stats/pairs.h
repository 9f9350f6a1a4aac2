#pragma once

#include "mis/report/strategy_report.h"
#include "mis/stats/estimate.h"

#include <span>
#include <vector>

namespace mis {

/// Two strategies compared in one figure: what is known of the logarithm of a's over b's, and what
/// follows from it. value may be −∞ or +∞, with se 0, where one of the two figures is exactly 0.
struct Comparison {
    int a = 0, b = 0;
    LogEstimate log_ratio;
    Verdict verdict = Verdict::undecided;
};

/// Holm 1979: which hypotheses fall, with at most `error` probability that any of them is true.
std::vector<bool> holm(std::span<const double> p, double error);

/// Decides every comparison of one family.
/// apart: the ratio is not 1. tied: neither figure is above 1 + margin times the other (two
/// one-sided tests, Schuirmann 1987); a pair for which both hold is tied. The probability that any
/// `apart` is wrong is at most `error`, and likewise for `tied` (Holm 1979; docs/theory.md §15).
void decide(std::span<Comparison> family, double margin, double error);

/// About how many replicates more, of the same size, would decide this comparison of a family of
/// `pairs`; 0 if it is decided, NaN if no error is known.
double replicates_to_decide(const Comparison& comparison, std::size_t pairs, double replicates,
                            double margin, double error);

/// Which places a strategy can hold among `count`, by the pairs that are apart: 1 + the surely
/// better, count − the surely worse.
struct RankInterval {
    int low = 1, high = 1;
};
std::vector<RankInterval> rank_intervals(std::span<const Comparison> family,
                                         std::span<const int> members, std::size_t strategies);

}  // namespace mis
