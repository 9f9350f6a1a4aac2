#pragma once

#include <cstdint>

namespace mis {

/// Where the random numbers of a strategy's samples come from.
struct NumberSource {
    std::uint64_t seed = 1;

    /// 0: every sample's numbers are independent of all others'. n: sample s is point s mod n of a
    /// Sobol' sequence, scrambled anew for every shading point and every n samples (sobol.h).
    std::uint64_t samples_per_scrambling = 0;

    /// Did the user name the source? `strata` draws from sequences where he did not.
    bool is_asked_for = false;

    NumberSource(std::uint64_t number, std::uint64_t samples = 0)  // NOLINT: a seed is a source
        : seed(number), samples_per_scrambling(samples)
    {
    }
    NumberSource() = default;

    bool is_sobol() const { return samples_per_scrambling > 0; }
};

/// Samples per scrambling that no run comes to: all of a point's are points of one sequence.
inline constexpr std::uint64_t one_scrambling = std::uint64_t{1} << 40;

}  // namespace mis
