#pragma once

#include "mis/report/report.h"
#include "mis/stats/measurements.h"

namespace mis {

/// Fewer samples than this that carry the variance (Participation::number), and it is not resolved.
/// At 100 the 95 % interval of a variance from 16 replicates still covers 93 to 95 times of 100,
/// and an `apart` is false at most 1.4 times as often as stated, for samples as skewed as
/// log-normal ones with σ = 1.5 (tests/stats/calibration_test.cpp); at 20 it is 89, and three
/// times.
inline constexpr double least_participation = 100;

/// Of those that are to be ranked it takes more. Draws that meet a sharp lobe by chance have tails
/// of a power law: on `veach` some 100 to 150 samples carry the variance of `solid-angle/light`,
/// however many are drawn, and what was not drawn yet would change it.
inline constexpr double least_participation_to_rank = 200;

/// A relative standard error of the variance above this, and it is not resolved, however many
/// samples carry it.
inline constexpr double largest_relative_error = 0.25;

/// The audit fails a strategy if the others' estimate of its variance, less so many of its standard
/// errors, …
inline constexpr double audit_errors = 3;
/// … is above this many times its own measured variance, plus as many of its standard errors.
inline constexpr double audit_factor = 1.2;

/// Why this strategy's variance is not resolved; None if it is. Tests, in this order: what the
/// other strategies' samples say (audit); at least two replicates; no variance that is zero without
/// a proof; participation in the variance and in the relative variance; spread of the replicates.
/// Where shared directions say what its variance is: that it is three standard errors above 0, and
/// their spread. Precondition: the strategy was run.
Reason why_not_resolved(const StrategyMeasurements& strategy);

/// The same by all tests that take no reference: not the participation in the relative variance.
Reason why_variance_not_resolved(const StrategyMeasurements& strategy);

/// Why its samples missed what matters, as far as is known: the audit, or no variance without a
/// proof. None if nothing says so.
Reason why_blind(const StrategyMeasurements& strategy);

/// Does the audit find more variance than its own samples show?
bool is_refuted(const StrategyMeasurements& strategy);

/// How many times its own variance, and relative variance, the other strategies' samples find at
/// least: 1 where the audit has nothing against it, or its own is 0.
AuditedGrowth audited_growth(const StrategyMeasurements& strategy);

/// About how many times as many samples it takes for a strategy that is not resolved to be: by its
/// participations and the spread of its replicates; at least 2 where the audit or a variance of
/// zero is against it, of which nobody knows.
double resolving_factor(const StrategyMeasurements& strategy);

}  // namespace mis
