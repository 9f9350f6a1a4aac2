#pragma once

#include <cstdint>
#include <span>

namespace mis {

/// Statistical tests draw this share of their numbers where every access is checked: sanitizers
/// cost a factor of ten.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr double sample_share = 0.1;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(memory_sanitizer)
inline constexpr double sample_share = 0.1;
#else
inline constexpr double sample_share = 1;
#endif
#else
inline constexpr double sample_share = 1;
#endif

/// `n`, or fewer under a sanitizer.
constexpr int scaled(int n) { return static_cast<int>(n * sample_share); }

/// p-value of Pearson's χ² test. Cells that expect fewer than 5 draws are pooled; a draw that was
/// called impossible gives 0, and so does an expectation that is no number.
double chi2_p_value(std::span<const double> observed, std::span<const double> expected);

/// What the absolute value of a normal z exceeds with probability false_alarm/tests: a bound for
/// `tests` z-values, of which any exceeds it with probability `false_alarm` at most (Bonferroni).
double z_bound(double false_alarm, int tests);

/// 64 random bits, the i-th of a sequence.
std::uint64_t random_bits(std::uint64_t seed, std::uint64_t i);

}  // namespace mis
