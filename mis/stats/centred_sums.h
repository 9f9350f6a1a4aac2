#pragma once

#include <array>
#include <cstddef>

namespace mis {

/// Sums over independent replicates of one figure, and their squares.
struct ReplicateSquares {
    double sum = 0, squares = 0;

    void add(double x) { sum += x, squares += x * x; }
    double mean(double n) const { return sum / n; }
    /// Squared standard error of the mean of n ≥ 2.
    double squared_error(double n) const;
};

/// Groups of shared directions: independent of one another, and alike.
inline constexpr std::size_t shared_groups = 4;

/// What shared directions say of one technique's draw, of value y and density p: sums over the
/// directions, drawn with density D, of (y − c) and its square, times the share p/D. c is any
/// number that does not depend on these directions; the closer to the mean of y, the less noise
/// (docs/theory.md §25; a control variate of a mixture: Owen and Zhou 2000).
class CentredSums {
public:
    explicit CentredSums(double center = 0) : center_(center) {}

    /// A direction of a group, drawn by density D; value and share may be 0.
    void add(std::size_t group, double value, double share)
    {
        const double off = value - center_;
        square_ += off * off * share, first_[group] += off * share, mass_ += share;
    }

    /// The technique draws with this probability in each group, wherever: worth 0 but for what
    /// add_beyond_0 says.
    void add_known(double probability)
    {
        for (std::size_t g = 0; g < shared_groups; ++g) add(g, 0, probability);
    }
    /// A direction whose share is in what is known already.
    void add_beyond_0(std::size_t group, double value, double share)
    {
        square_ += value * (value - 2 * center_) * share, first_[group] += value * share;
    }

    /// ∫ y² p − (∫ y p)², unbiased, from all groups.
    double variance() const;
    /// ∫ y p.
    double mean() const;
    /// ∫ p.
    double mass() const { return mass_ / groups; }

private:
    static constexpr double groups = static_cast<double>(shared_groups);
    double center_, square_ = 0, mass_ = 0;
    std::array<double, shared_groups> first_{};
};

/// The square of an expectation, unbiased, from independent values: all pairs of different ones.
double squared_expectation(const std::array<double, shared_groups>& values);

}  // namespace mis
