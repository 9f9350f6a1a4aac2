#include "mis/sampling/hemisphere_integral.h"

#include "mis/math/gauss_legendre.h"
#include "mis/math/limits.h"
#include "mis/math/stable.h"
#include "mis/sampling/random.h"
#include "mis/sampling/warp.h"

#include <algorithm>
#include <cmath>

namespace mis {
namespace {

constexpr double pi1 = pi<double>;
constexpr double ln_sqrt2 = 0.34657359027997265471;

HemisphereDraw draw_angles(const Vec2<double>& u)
{
    const double theta = pi1 / 2 * u.x;  // φ = 2π u.y does not matter here
    return {std::cos(theta), inverse(pi1 * pi1 * std::sin(theta))};
}

HemisphereDraw draw_blinn(const Vec2<double>& u, double m)
{
    const Vec3<double> h = sample_lobe(u, m);
    const double sin2 = h.x * h.x + h.y * h.y;
    return {1 - 2 * sin2, lobe_pdf(sin2, h.z * h.z, m) / (4 * h.z)};  // dω = 4 (wo·h) dω_h
}

/// ∫ (m+1)² (e^{2t} − 1)² e^{(3−m)t} ds over s = (m+1) t up to `end`: the second moment of `blinn`
/// from the horizon (s = 0) up, but for its factor. With cos θ_h = e^t/√2 nothing cancels, and s
/// keeps the peak in place for every m.
double blinn_moment(double m, double end)
{
    const auto f = [m](double s) {
        const double root = (m + 1) * std::expm1(2 * s / (m + 1));
        return root * root * std::exp((3 - m) / (m + 1) * s);
    };
    constexpr double nothing_left = 60;  // the rest is below e^-50 of the whole
    constexpr int panels = 32;
    return integrate(f, 0, std::min(end, nothing_left), panels);
}

/// Where θ = 0.
double blinn_end(double m) { return (m + 1) * ln_sqrt2; }

/// E[value²] = 64π²/(m+1) ∫ (2c² − 1)² c^{2−m} dc over c = cos θ_h in [1/√2, 1]
///           = 64π² 2^{(m−3)/2}/(m+1)⁴ · blinn_moment, as a power of 2.
double blinn_log2_second_moment(double m)
{
    return (m - 3) / 2 - 4 * std::log2(m + 1) +
           std::log2(64 * pi1 * pi1 * blinn_moment(m, blinn_end(m)));
}

/// Of value = 8π/(m+1) (2c² − 1) c^{1−m} over c: at c² = (m−1)/(2(m−3)), or at θ = 0 where that is
/// no cosine.
double blinn_log2_largest_value(double m)
{
    if (m <= 5) return std::log2(8 * pi1 / (m + 1));
    return std::log2(16 * pi1) - std::log2(m + 1) - std::log2(m - 3) +
           (m - 1) / 2 * std::log2(2 * ((m - 3) / (m - 1)));
}

ExactHemisphere exact_blinn(double m)
{
    const double log10_of_2 = std::log10(2.0);
    const double log2_square = blinn_log2_second_moment(m),
                 log2_largest = blinn_log2_largest_value(m);
    const double variance = std::exp2(log2_square) - pi1 * pi1;
    return {.mean = pi1,
            .variance = variance,
            .log10_variance = variance < infinity ? std::log10(variance) : log2_square * log10_of_2,
            .largest_value = std::exp2(log2_largest),
            .log10_largest_value = log2_largest * log10_of_2,
            .below_horizon = std::exp2(-(m + 1) / 2)};  // P(cos θ_h < 1/√2)
}

ExactHemisphere exact_bounded(double mean, double variance, double largest_value)
{
    return {mean, variance, std::log10(variance), largest_value, std::log10(largest_value), 0};
}

}  // namespace

const HemisphereDensityText& text_of(HemisphereDensity density)
{
    static constexpr std::array<HemisphereDensityText, hemisphere_densities.size()> texts{{
        {"hemisphere", "uniform in solid angle", "1/(2π)", "π²/3"},
        {"cosine", "in proportion to cos θ", "cos θ/π", "0: every value is π, to rounding"},
        {"angles", "θ = π/2 u, φ = 2π v", "1/(π² sin θ)", "π⁴/8 − π²"},
        {"angles-as-uniform", "those of angles, taken for uniform", "1/(2π), which is wrong",
         "2π² − 16"},
        {"blinn", "h ∝ cos^m θ_h, wi = n reflected about h", "(m+1)/(8π) cos^(m−1) θ_h",
         "64π²/(m+1) ∫(2c²−1)² c^(2−m) dc − π² over c = cos θ_h in [1/√2, 1]:\n"
         "    finite for every m, but it grows like 2^(m/2)/m⁴"},
    }};
    return texts[static_cast<std::size_t>(density)];
}

HemisphereDraw draw(const HemisphereEstimator& estimator, const Vec2<double>& u)
{
    switch (estimator.density) {
        case HemisphereDensity::cosine: {
            const double cos_theta = sample_cosine(u).z;
            return {cos_theta, cosine_pdf(cos_theta)};
        }
        case HemisphereDensity::angles: return draw_angles(u);
        case HemisphereDensity::angles_as_uniform:
            return {draw_angles(u).cos_theta, hemisphere_pdf<double>()};
        case HemisphereDensity::blinn: return draw_blinn(u, estimator.exponent);
        case HemisphereDensity::hemisphere: break;
    }
    return {sample_hemisphere(u).z, hemisphere_pdf<double>()};
}

ExactHemisphere exact(const HemisphereEstimator& estimator)
{
    constexpr double pi2 = pi1 * pi1;
    switch (estimator.density) {
        case HemisphereDensity::cosine: return exact_bounded(pi1, 0, pi1);
        case HemisphereDensity::angles:
            return exact_bounded(pi1, pi2 * pi2 / 8 - pi2, pi2 / 2);  // value π²/2 sin 2θ
        case HemisphereDensity::angles_as_uniform:
            return exact_bounded(4, 2 * pi2 - 16, 2 * pi1);  // E cos θ = 2/π
        case HemisphereDensity::blinn: return exact_blinn(estimator.exponent);
        case HemisphereDensity::hemisphere: break;
    }
    return exact_bounded(pi1, pi2 / 3, 2 * pi1);
}

Unseen unseen(const HemisphereEstimator& estimator, std::uint64_t draws)
{
    if (estimator.density != HemisphereDensity::blinn || draws == 0) return {0, 0};
    const double m = estimator.exponent, whole = blinn_end(m);
    // From the horizon up to where P(c_horizon < cos θ_h < c) = c^{m+1} − 2^{−(m+1)/2} comes to
    // 1/draws.
    const double x = whole - std::log(static_cast<double>(draws));
    const double end = std::min(whole, std::max(x, 0.0) + std::log1p(std::exp(-std::fabs(x))));
    const double cos_theta = std::expm1(2 * end / (m + 1));
    return {std::min(1.0, cos_theta * cos_theta), blinn_moment(m, end) / blinn_moment(m, whole)};
}

void HemisphereRun::advance_to(std::uint64_t count)
{
    std::array<double, chunk> batch;
    while (values.count < count) {
        const std::uint64_t first = values.count, size = std::min(chunk, count - first);
        for (std::uint64_t i = 0; i < size; ++i) {
            const Words words = random_words(seed, {0, first + i, 0}, Block::bsdf);
            const HemisphereDraw one =
                draw(estimator, {unit_number<double>(words[2]), unit_number<double>(words[3])});
            batch[i] = value_of(one);
            below_horizon += one.cos_theta <= 0 ? 1 : 0;
        }
        values.merge(Moments::of(std::span<const double>(batch).first(size)));
    }
}

}  // namespace mis
