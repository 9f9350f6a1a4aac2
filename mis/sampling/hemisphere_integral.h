#pragma once

#include "mis/math/moments.h"
#include "mis/math/vec.h"

#include <array>
#include <cstdint>
#include <string_view>

namespace mis {

// ∫ cos θ dω over the hemisphere about n = z, which is π, as the mean of cos θ/pdf over drawn
// directions; a direction below the horizon counts as 0. What is known of each density exactly
// stands beside what a run of draws measures.

inline constexpr double hemisphere_integral = 3.14159265358979323846;

/// How directions are drawn, and the density that they are taken to have. `angles_as_uniform` is
/// the classic mistake: the draws of `angles`, divided by the density of uniform ones.
enum class HemisphereDensity { hemisphere, cosine, angles, angles_as_uniform, blinn };

inline constexpr std::array hemisphere_densities{
    HemisphereDensity::hemisphere, HemisphereDensity::cosine, HemisphereDensity::angles,
    HemisphereDensity::angles_as_uniform, HemisphereDensity::blinn};

/// In words and formulas, for people.
struct HemisphereDensityText {
    std::string_view name, draws, pdf, variance;
};
const HemisphereDensityText& text_of(HemisphereDensity density);

struct HemisphereEstimator {
    HemisphereDensity density = HemisphereDensity::hemisphere;
    double exponent = 0;  ///< m of `blinn`, finite and at least 0; not used by others
};

/// A drawn direction, as far as the integral asks; pdf per steradian, infinite at the pole of
/// `angles`.
struct HemisphereDraw {
    double cos_theta, pdf;
};

/// u: two uniform numbers in [0, 1).
/// `blinn`: the half vector has a density ∝ cos^m θ_h; wi is wo = n reflected about it, at twice
/// the angle θ_h.
HemisphereDraw draw(const HemisphereEstimator& estimator, const Vec2<double>& u);

/// cos θ/pdf; 0 below the horizon.
inline double value_of(const HemisphereDraw& draw)
{
    return draw.cos_theta > 0 ? draw.cos_theta / draw.pdf : 0;
}

/// What infinitely many draws would say. All but the logarithms may be infinite where a double ends
/// (m > 2000).
struct ExactHemisphere {
    double mean;                                ///< π, or what the wrong density leads to
    double variance, log10_variance;            ///< of one value; relative error below 1e-10
    double largest_value, log10_largest_value;  ///< of all values: what makes the variance finite
    double below_horizon;                       ///< probability of a draw that is lost
};
ExactHemisphere exact(const HemisphereEstimator& estimator);

/// How much lies in directions of the hemisphere so seldom drawn, all together, that fewer than one
/// of `draws` is expected there. Where it is most of the second moment, neither the mean nor its
/// standard error of such a run means anything, although the mean is unbiased. None for all but
/// `blinn`, whose density alone spans orders of magnitude.
struct Unseen {
    double of_integral, of_second_moment;  ///< shares in [0, 1]
};
Unseen unseen(const HemisphereEstimator& estimator, std::uint64_t draws);

/// The first draws of a seed. Same seed and estimator, same bits, in whatever steps one advances by
/// multiples of `chunk`.
struct HemisphereRun {
    static constexpr std::uint64_t chunk = 4096;

    HemisphereEstimator estimator;
    std::uint64_t seed = 1;
    Moments values;
    std::uint64_t below_horizon = 0;

    /// Draws until there are `count`.
    void advance_to(std::uint64_t count);
};

}  // namespace mis
