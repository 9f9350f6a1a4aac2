#include "mis/sampling/hemisphere_integral.h"

#include "tests/support/quadrature.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <boost/math/special_functions/beta.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace mis {
namespace {

constexpr double pi1 = std::numbers::pi;
constexpr double false_alarm = 1e-6;  // per test; the seed is fixed, so a red run stays red

std::vector<HemisphereEstimator> estimators()
{
    std::vector<HemisphereEstimator> list{{HemisphereDensity::hemisphere},
                                          {HemisphereDensity::cosine},
                                          {HemisphereDensity::angles},
                                          {HemisphereDensity::angles_as_uniform}};
    for (const double m : {0.0, 0.5, 1.0, 3.0, 5.0, 10.0})
        list.push_back({HemisphereDensity::blinn, m});
    return list;
}

std::string name_of(const HemisphereEstimator& e)
{
    return std::string(text_of(e.density).name) + " " + std::to_string(e.exponent);
}

HemisphereRun run_of(const HemisphereEstimator& estimator, std::uint64_t count)
{
    HemisphereRun run{.estimator = estimator, .seed = 3};
    run.advance_to(count);
    return run;
}

/// The density at θ that draws really have, from the textbook.
double pdf_at(const HemisphereEstimator& e, double theta)
{
    switch (e.density) {
        case HemisphereDensity::hemisphere: return 1 / (2 * pi1);
        case HemisphereDensity::cosine: return std::cos(theta) / pi1;
        case HemisphereDensity::angles:
        case HemisphereDensity::angles_as_uniform: return 1 / (pi1 * pi1 * std::sin(theta));
        case HemisphereDensity::blinn: break;
    }
    const double c = std::cos(theta / 2);
    return (e.exponent + 1) / (2 * pi1) * std::pow(c, e.exponent) / (4 * c);
}

/// ∫ value^power · pdf dω over the directions from θ = from to the horizon.
double moment(const HemisphereEstimator& e, int power, double from = 0)
{
    return integral<40>(from, pi1 / 2, [&](double theta) {
        const double pdf = pdf_at(e, theta);
        const double taken =
            e.density == HemisphereDensity::angles_as_uniform ? 1 / (2 * pi1) : pdf;
        return std::pow(std::cos(theta) / taken, power) * pdf * 2 * pi1 * std::sin(theta);
    });
}

TEST(HemisphereIntegral, ExactFiguresAgreeWithQuadratureOverTheta)
{
    std::vector<HemisphereEstimator> list = estimators();
    for (const double m : {3.0001, 7.0, 30.0, 60.0}) list.push_back({HemisphereDensity::blinn, m});
    for (const HemisphereEstimator& e : list) {
        const ExactHemisphere figures = exact(e);
        EXPECT_NEAR(moment(e, 1), figures.mean, 1e-10) << name_of(e);
        EXPECT_NEAR(moment(e, 0), 1 - figures.below_horizon, 1e-10) << name_of(e);
        EXPECT_NEAR(moment(e, 2) - figures.mean * figures.mean, figures.variance,
                    1e-10 * (1 + figures.variance))
            << name_of(e);
    }
}

TEST(HemisphereIntegral, VarianceOfBlinnIsAnIncompleteBetaFunction)  // with y = 1 − 1/(2c²)
{
    for (const double m : {7.5, 10.0, 33.3, 100.0, 400.0, 1500.0}) {
        const double square = 64 * pi1 * pi1 / (m + 1) * std::exp2((m - 3) / 2) / 2 *
                              boost::math::beta(3.0, (m - 7) / 2, 0.5);
        EXPECT_NEAR(exact({HemisphereDensity::blinn, m}).variance / (square - pi1 * pi1), 1, 1e-10)
            << m;
    }
}

TEST(HemisphereIntegral, VarianceOfBlinnIsFiniteForEveryExponentAlthoughADoubleMayNotHoldIt)
{
    for (const double m : {2000.0, 1e4, 1e6, 1e9, 1e300, std::numeric_limits<double>::max()}) {
        const ExactHemisphere figures = exact({HemisphereDensity::blinn, m});
        const double expected =
            std::log10(512 * pi1 * pi1) + (m - 3) / 2 * std::log10(2.0) - 4 * std::log10(m);
        EXPECT_NEAR(figures.log10_variance, expected, 20 / m + 1e-12 * expected) << m;
        EXPECT_TRUE(std::isfinite(figures.log10_largest_value)) << m;
        EXPECT_LE(figures.log10_variance, 2 * figures.log10_largest_value) << m;
        EXPECT_EQ(std::isfinite(figures.variance), figures.log10_variance < 308) << m;
        EXPECT_TRUE(std::isfinite(run_of({HemisphereDensity::blinn, m}, 5000).values.mean)) << m;
    }
}

TEST(HemisphereIntegral, MeanOfADrawIsTheExactMean)
{
    const double bound = z_bound(false_alarm, static_cast<int>(estimators().size()));
    for (const HemisphereEstimator& e : estimators()) {
        const HemisphereRun run = run_of(e, static_cast<std::uint64_t>(scaled(1'000'000)));
        const double rounding = 1e-15;
        EXPECT_LE(std::fabs(run.values.mean - exact(e).mean),
                  bound * run.values.mean_se() + rounding)
            << name_of(e);
    }
}

TEST(HemisphereIntegral, MeasuredVarianceIsTheExactVariance)
{
    const double bound = z_bound(false_alarm, static_cast<int>(estimators().size()));
    for (const HemisphereEstimator& e : estimators()) {
        const Moments values = run_of(e, static_cast<std::uint64_t>(scaled(1'000'000))).values;
        EXPECT_LE(std::fabs(values.variance() - exact(e).variance),
                  bound * values.variance_se() + 1e-30)
            << name_of(e);
    }
}

TEST(HemisphereIntegral, AnglesTakenForUniformTendTo4AndNotToPi)
{
    const Moments wrong = run_of({HemisphereDensity::angles_as_uniform}, 100'000).values;
    const Moments right = run_of({HemisphereDensity::angles}, 100'000).values;
    EXPECT_LE(std::fabs(wrong.mean - 4), z_bound(false_alarm, 2) * wrong.mean_se());
    EXPECT_GT(std::fabs(wrong.mean - pi1),
              100 * wrong.mean_se());  // the twin: MeanOfADraw… would see it
    EXPECT_LE(std::fabs(right.mean - pi1), z_bound(false_alarm, 2) * right.mean_se());
}

TEST(HemisphereIntegral, EveryValueOfCosineIsPi)
{
    for (const double u : {0.0, 0x1p-32, 0.3, 0.5, 0.9, 1 - 0x1p-32})
        EXPECT_DOUBLE_EQ(value_of(draw({HemisphereDensity::cosine}, {u, 0.7})), pi1) << u;
    EXPECT_LT(run_of({HemisphereDensity::cosine}, 100'000).values.variance(), 1e-30);
    EXPECT_EQ(exact({HemisphereDensity::cosine}).variance, 0);
}

TEST(HemisphereIntegral, BlinnLosesBelowTheHorizonWhatItsClosedFormSays)
{
    const auto count = static_cast<std::uint64_t>(scaled(1'000'000));
    const auto n = static_cast<double>(count);
    const std::vector<double> exponents{0, 0.5, 1, 3, 10, 20};
    for (const double m : exponents) {
        const double expected = std::pow(2, -(m + 1) / 2);
        const HemisphereEstimator e{HemisphereDensity::blinn, m};
        EXPECT_NEAR(exact(e).below_horizon, expected, 1e-15) << m;
        const double se = std::sqrt(expected * (1 - expected) / n);
        EXPECT_LE(std::fabs(static_cast<double>(run_of(e, count).below_horizon) / n - expected),
                  z_bound(false_alarm, static_cast<int>(exponents.size())) * se)
            << m;
    }
    for (const HemisphereEstimator& e : estimators())
        if (e.density != HemisphereDensity::blinn) {
            EXPECT_EQ(run_of(e, 10'000).below_horizon, 0u) << name_of(e);
        }
}

TEST(HemisphereIntegral, NoValueExceedsTheLargestAndOneReachesIt)
{
    std::vector<HemisphereEstimator> list = estimators();
    list.push_back({HemisphereDensity::blinn, 100});
    for (const HemisphereEstimator& e : list) {
        double largest = 0;
        // Near u.x = 1 in ever finer steps: there lie the grazing directions, where blinn's values
        // are largest.
        for (int i = 0; i < 200'000; ++i) {
            const double u = i % 2 == 0 ? i / 200'000.0 : -std::expm1(-i / 5000.0);
            const double value = value_of(draw(e, {std::min(u, std::nextafter(1.0, 0.0)), 0.25}));
            largest = std::max(largest, value);
        }
        const double bound = exact(e).largest_value;
        EXPECT_LE(largest, bound * (1 + 1e-12)) << name_of(e);
        EXPECT_GE(largest, bound * (1 - 1e-3)) << name_of(e);
    }
}

TEST(HemisphereIntegral, UnseenDirectionsAreThoseOfLessThanOneExpectedDraw)
{
    for (const double m : {2.0, 10.0, 50.0})
        for (const std::uint64_t draws : {10ull, 10'000ull}) {
            const HemisphereEstimator e{HemisphereDensity::blinn, m};
            const Unseen hidden = unseen(e, draws);
            const double theta = std::acos(std::sqrt(hidden.of_integral));
            EXPECT_NEAR(moment(e, 0, theta) * static_cast<double>(draws), 1, 1e-9)
                << m << " " << draws;
            EXPECT_NEAR(moment(e, 1, theta) / pi1, hidden.of_integral, 1e-10) << m << " " << draws;
            EXPECT_NEAR(moment(e, 2, theta) / moment(e, 2), hidden.of_second_moment, 1e-9)
                << m << " " << draws;
        }
}

TEST(HemisphereIntegral, ARunOfASharpLobeSeesLittleOfItsVariance)
{
    const HemisphereEstimator sharp{HemisphereDensity::blinn, 100},
        broad{HemisphereDensity::blinn, 10};
    EXPECT_GT(unseen(sharp, 10'000).of_second_moment, 0.99);
    EXPECT_LT(unseen(broad, 10'000).of_second_moment, 1e-4);
    EXPECT_EQ(unseen({HemisphereDensity::angles}, 1).of_second_moment, 0);
    const Moments values = run_of(sharp, 10'000).values;
    EXPECT_LT(values.variance(), 1e-3 * exact(sharp).variance);
    const Unseen one = unseen(sharp, 1);
    EXPECT_DOUBLE_EQ(one.of_integral, 1);
    EXPECT_DOUBLE_EQ(one.of_second_moment, 1);
}

TEST(HemisphereIntegral, TheSameSeedGivesTheSameBitsInAnySteps)
{
    for (const HemisphereEstimator& e : estimators()) {
        HemisphereRun stepwise{.estimator = e, .seed = 3};
        for (const std::uint64_t count : {1, 4, 20})
            stepwise.advance_to(count * HemisphereRun::chunk);
        const HemisphereRun at_once = run_of(e, 20 * HemisphereRun::chunk);
        EXPECT_EQ(stepwise.values.mean, at_once.values.mean) << name_of(e);
        EXPECT_EQ(stepwise.values.m4, at_once.values.m4) << name_of(e);
        EXPECT_EQ(stepwise.below_horizon, at_once.below_horizon) << name_of(e);
        HemisphereRun other{.estimator = e, .seed = 4};
        other.advance_to(100);
        if (e.density != HemisphereDensity::cosine) {
            EXPECT_NE(other.values.mean, run_of(e, 100).values.mean) << name_of(e);
        }
    }
}

}  // namespace
}  // namespace mis
