#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace mis {

/// ∫ p (X − shift)^m for m = 1 … 4 over the draws that can count, each with a bound of its error.
struct Sums {
    std::array<double, 4> value{}, error{};

    void add(const double* values, const double* errors)
    {
        for (std::size_t m = 0; m < 4; ++m) value[m] += values[m], error[m] += errors[m];
    }
};

/// One kind of independent draw of a strategy: how often a sample makes it, and its moments.
struct DrawMoments {
    double draws = 1;  ///< per sample
    double shift =
        0;  ///< 0, or near the mean: then every draw counts, and the moments are of X − shift
    Sums sums;
};

/// All of one strategy's draws. In the one-sample model they are the halves of one draw.
struct StrategyMoments {
    bool is_one_sample = false;
    std::vector<DrawMoments>
        light;  ///< one; with `all`, one per light; none where no light is chosen
    std::vector<DrawMoments> bsdf;  ///< one or none
};

/// A figure and a bound of how far off it can be.
struct Bounded {
    double value = 0, error = 0;
};

/// Mean, variance and fourth central moment of a sum of independent draws (docs/theory-predict.md,
/// P7 to P10).
struct MomentFigures {
    Bounded mean, variance, fourth;
};

/// rounding: relative error of one value of X.
MomentFigures figures_of(const StrategyMoments& moments, double rounding);

}  // namespace mis
