#pragma once

#include "mis/math/lanes.h"

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace mis {

/// Σ f(x) in four sums that do not wait for one another.
template <class T, class F> MIS_INLINE double sum_in_four(std::span<const T> numbers, const F& f)
{
    std::array<double, 4> sum{};
    std::size_t i = 0;
    for (; i + 4 <= numbers.size(); i += 4)
        for (std::size_t k = 0; k < 4; ++k) sum[k] += f(static_cast<double>(numbers[i + k]));
    for (; i < numbers.size(); ++i) sum[i % 4] += f(static_cast<double>(numbers[i]));
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Count, mean and central sums to the fourth of many numbers: M_p = Σ (x − mean)^p. Double,
/// whatever was added. Two sets of moments merge exactly (to rounding), in any order and grouping;
/// the same order gives the same bits. Source: Chan, Golub and LeVeque 1979 (mean, M2); Pébay 2008,
/// SAND2008-6212 (M3, M4, pairwise).
struct Moments {
    std::uint64_t count = 0;
    double mean = 0, m2 = 0, m3 = 0, m4 = 0;

    /// Of all of `samples`, in two passes: the accurate and, for more than a few, the fast way.
    template <std::floating_point T> MIS_INLINE static Moments of(std::span<const T> samples);

    /// One more number (Pébay 2008, the case n_B = 1).
    void add(double x);

    /// All that `other` holds, too.
    void merge(const Moments& other);

    /// Unbiased, n − 1; NaN for fewer than two numbers.
    double variance() const { return count < 2 ? nan() : m2 / (number() - 1); }

    /// n·M4/M2²: 3 for normal numbers, 1/p for a rare event of probability p; NaN where all are
    /// equal.
    double kurtosis() const { return m2 > 0 ? number() * (m4 / m2) / m2 : nan(); }

    /// How many of the numbers carry the variance: (Σd²)²/Σd⁴, in [1, n]; 0 where all are equal.
    double effective_count() const { return m4 > 0 ? m2 / m4 * m2 : 0; }

    /// Standard error of the mean; NaN for fewer than two numbers.
    double mean_se() const { return count < 2 ? nan() : std::sqrt(variance() / number()); }

    /// Standard error of variance(): Var(s²) = (μ4 − σ⁴(n−3)/(n−1))/n, with M4/n and s² put in for
    /// μ4 and σ⁴; NaN for fewer than two numbers, and never below 0.
    double variance_se() const;

private:
    static double total(const std::array<double, 4>& parts)
    {
        return (parts[0] + parts[1]) + (parts[2] + parts[3]);
    }
    static constexpr double nan() { return std::numeric_limits<double>::quiet_NaN(); }
    double number() const { return static_cast<double>(count); }
};
static_assert(sizeof(Moments) == 40);

/// Count, mean and sum of squared distances from it: as much of the moments as a variance takes.
struct Spread {
    double count = 0, mean = 0, m2 = 0;

    /// Of all of `samples`, in two passes.
    static Spread of(std::span<const double> samples)
    {
        Spread spread{static_cast<double>(samples.size()), 0, 0};
        for (const double x : samples) spread.mean += x;
        spread.mean /= spread.count;
        for (const double x : samples) spread.m2 += (x - spread.mean) * (x - spread.mean);
        return spread;
    }
    /// All that `other` holds, too (Chan, Golub and LeVeque 1983).
    void merge(const Spread& other)
    {
        if (count == 0) {
            *this = other;
            return;
        }
        const double n = count + other.count, delta = other.mean - mean;
        m2 += other.m2 + delta * delta * count * other.count / n;
        mean += delta * other.count / n;
        count = n;
    }
};

template <std::floating_point T> MIS_INLINE Moments Moments::of(std::span<const T> samples)
{
    Moments result;
    result.count = samples.size();
    if (samples.empty()) return result;
    const double n = result.number();
    const double origin =
        static_cast<double>(samples[0]);  // so that a huge offset costs no digits of the mean
    const auto less_origin = [=](double x) __attribute__((always_inline)) { return x - origin; };
    const double shift = sum_in_four(samples, less_origin) / n;
    std::array<double, 4> rest{}, m2{}, m3{}, m4{};
    const auto add = [&](std::size_t i, std::size_t k) __attribute__((always_inline))
    {
        const double d = (static_cast<double>(samples[i]) - origin) - shift, d2 = d * d;
        rest[k] += d, m2[k] += d2, m3[k] += d2 * d, m4[k] += d2 * d2;
    };
    std::size_t i = 0;
    for (; i + 4 <= samples.size(); i += 4)
        for (std::size_t k = 0; k < 4; ++k) add(i + k, k);
    for (; i < samples.size(); ++i) add(i, i % 4);
    result.m3 = total(m3), result.m4 = total(m4);
    // What the mean was wrong by, to rounding (the corrected two passes of Chan, Golub and LeVeque
    // 1983).
    const double missed = total(rest);
    result.m2 = std::fmax(0, total(m2) - missed * missed / n);
    result.mean = origin + shift;
    return result;
}

inline void Moments::add(double x)
{
    const double before = number();
    ++count;
    const double n = number(), delta = x - mean, d = delta / n;
    const double step = delta * d * before;  // what M2 grows by
    m4 += step * d * d * (n * n - 3 * n + 3) + 6 * d * d * m2 - 4 * d * m3;
    m3 += step * d * (n - 2) - 3 * d * m2;
    m2 += step;
    mean += d;
}

inline void Moments::merge(const Moments& other)
{
    if (other.count == 0) return;
    if (count == 0) {
        *this = other;
        return;
    }
    const double na = number(), nb = other.number(), n = na + nb;
    const double delta = other.mean - mean, d = delta / n, d2 = d * d;
    const double step = delta * d * na * nb;
    m4 += other.m4 + step * d2 * (na * na - na * nb + nb * nb) +
          6 * d2 * (na * na * other.m2 + nb * nb * m2) + 4 * d * (na * other.m3 - nb * m3);
    m3 += other.m3 + step * d * (na - nb) + 3 * d * (na * other.m2 - nb * m2);
    m2 += other.m2 + step;
    mean += d * nb;
    count += other.count;
}

inline double Moments::variance_se() const
{
    const double n = number(), s2 = variance();
    return count < 2 ? nan() : std::sqrt(std::fmax(0, (m4 / n - s2 * s2 * (n - 3) / (n - 1)) / n));
}

}  // namespace mis
