#pragma once

#include "mis/report/report.h"

#include <optional>

namespace mis {

/// The figures of a strategy that was run at `at` samples per observation, or whose variance is the
/// same for all counts, where a point gets n. Bounds of seconds are sums of bounds: wide enough.
CountFigures at_count(const StrategyReport& strategy, double at, double n);

/// Relative variance × seconds of a over those of b, at one n: a's time to any one error over b's.
/// Its interval takes the four figures for independent, so it is too wide where they vary together.
Interval cost_ratio(const CountFigures& a, const CountFigures& b);

/// Another strategy that is surely best where a point gets so many samples.
struct BestAtCount {
    int best = 0;     ///< index into SceneReport::strategies
    Interval sooner;  ///< how many times sooner it reaches an error than the leader
};

/// The best at the k-th n of the report where that is not the leader and is surely ahead of it: the
/// interval of their ratio, made twice as wide, leaves out 1. With 16 replicates a strategy that is
/// no better passes once in 3000 times: enough for all of a scene together (docs/theory.md §24).
std::optional<BestAtCount> best_at_count(const SceneReport& scene, int leader, std::size_t k);

}  // namespace mis
