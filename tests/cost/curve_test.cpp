#include "mis/cost/curve.h"

#include "mis/cost/fit.h"
#include "tests/cost/synthetic_cost.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

constexpr CostGround ground_of_curve{.points = 1000, .threads = 2, .reference = {}};

bool holds(const Interval& x, double value) { return x.low <= value && value <= x.high; }

const TimeToError& time_to(const CostCurveReport& curve, double error)
{
    for (const TimeToError& t : curve.times)
        if (t.error == error) return t;
    throw std::logic_error("no such target");
}

TEST(Cost, FindsTheSlopeOfMinusOneHalf)
{
    const CostCurveReport curve = curve_report(measured({}), ground_of_curve);
    EXPECT_NEAR(curve.slope.value, -0.5, 0.01);
    EXPECT_TRUE(holds(curve.slope, -0.5));
    EXPECT_TRUE(curve.fits);
    EXPECT_TRUE(holds(curve.relative_variance, 0.01));
    EXPECT_NEAR(curve.relative_variance.value, 0.01, 2e-4);
}

TEST(Cost, SlopeIntervalsMissOneTimeInTwenty)
{
    constexpr int runs = 400;
    int misses = 0, false_alarms = 0;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
        const CostCurveReport curve =
            curve_report(measured({.noise = 0.1, .seed = seed}), ground_of_curve);
        misses += holds(curve.slope, -0.5) ? 0 : 1;
        false_alarms += curve.fits ? 0 : 1;
    }
    EXPECT_GE(misses, 5);
    EXPECT_LE(misses, 45);  // 20 expected; seeds are fixed
    EXPECT_LE(false_alarms, 4);
}

TEST(Cost, SaysThatABiasedStrategyFallsTooSlowlyAndExtrapolatesNothingOfIt)
{
    const CostCurveReport curve = curve_report(measured({.bias = 0.02}), ground_of_curve);
    EXPECT_GT(curve.slope.low, -0.5);
    EXPECT_FALSE(curve.fits);
    EXPECT_EQ(time_to(curve, 0.05).reach, Reach::measured);
    EXPECT_EQ(time_to(curve, 0.01).reach, Reach::unknown);
    EXPECT_TRUE(std::isnan(time_to(curve, 0.01).seconds.value));
}

TEST(Cost, MeasuresTimesBetweenLevelsAndMarksThoseBeyond)
{
    // error² = 0.01/n up to 64 samples: down to 1.25 %.
    const SyntheticCurve c{.prepare = 3e-7};
    const CostCurveReport curve = curve_report(measured(c), ground_of_curve);
    const auto expected = [&](double error) {
        return 500 * (c.prepare + c.variance / (error * error) * c.per_sample);
    };
    for (const double error : {0.05, 0.02}) {
        EXPECT_EQ(time_to(curve, error).reach, Reach::measured) << error;
        EXPECT_NEAR(time_to(curve, error).samples, 0.01 / (error * error), 0.5);
        EXPECT_TRUE(holds(time_to(curve, error).seconds, expected(error))) << error;
    }
    for (const double error : {0.01, 0.005}) {
        EXPECT_EQ(time_to(curve, error).reach, Reach::extrapolated) << error;
        EXPECT_NEAR(time_to(curve, error).seconds.value / expected(error), 1, 0.03);
        EXPECT_TRUE(holds(time_to(curve, error).seconds, expected(error))) << error;
    }
}

TEST(Cost, NeedsAtLeastOneSample)
{
    const SyntheticCurve c{.variance = 1e-4, .prepare = 3e-7};  // 1 % at once
    const TimeToError at_once = time_to(curve_report(measured(c), ground_of_curve), 0.1);
    EXPECT_EQ(at_once.reach, Reach::measured);
    EXPECT_EQ(at_once.samples, 1);
    EXPECT_NEAR(at_once.seconds.value, 500 * 4e-7, 500 * 4e-9);
}

TEST(Cost, TakesTheReferencesErrorOffAndTrustsNothingBelowIt)
{
    constexpr double squared = 1e-3;  // error² falls below it after 10 samples
    const CostGround noisy{.points = 1000,
                           .threads = 2,
                           .reference = {.squared = squared, .se = 1e-6, .floor = squared}};
    const CostCurveReport curve = curve_report(measured({.reference = squared}), noisy);
    EXPECT_EQ(curve.points[3].trust, Trust::trusted);          // 8 samples
    EXPECT_EQ(curve.points[4].trust, Trust::below_reference);  // 16
    EXPECT_TRUE(holds(curve.points[2].error, 0.05));
    EXPECT_EQ(curve.points[6].error.low, 0);  // an upper bound alone
    EXPECT_GE(curve.points[6].error.high, std::sqrt(0.01 / 64));
    EXPECT_NEAR(curve.slope.value, -0.5, 0.03);
    EXPECT_TRUE(curve.fits);
    EXPECT_NEAR(curve.relative_variance.value, 0.01, 5e-4);
    EXPECT_EQ(time_to(curve, 0.02).reach, Reach::extrapolated);
}

TEST(Cost, FitsNothingToWhatRareSamplesCarry)
{
    const CostCurveReport curve = curve_report(measured({.carriers = 10}), ground_of_curve);
    for (const CostPoint& point : curve.points) EXPECT_EQ(point.trust, Trust::rare_samples);
    EXPECT_TRUE(std::isnan(curve.slope.value));
    for (const TimeToError& t : curve.times) EXPECT_EQ(t.reach, Reach::unknown);
}

TEST(Cost, SplitsTimeIntoWhatAPointSharesAndSamples)
{
    const CostMeasurements m = measured({.prepare = 4e-7, .per_sample = 2e-7, .clock_noise = 0});
    const TimeObservation time = fitted_time(m.levels, 3);
    EXPECT_NEAR(time.seconds_per_point, 4e-7, 1e-15);
    EXPECT_NEAR(time.seconds_per_sample, 2e-7, 1e-15);
    const TimeObservation one = fitted_time(std::span(m.levels).first(1), 3);
    EXPECT_EQ(one.seconds_per_point, 0);
    EXPECT_NEAR(one.seconds_per_sample, 6e-7, 1e-15);
}

/// The second level was quicker than the first: a line would have no time per sample left.
TEST(Cost, NeverTakesNoTimePerSample)
{
    CostMeasurements m = measured({.prepare = 4e-7, .clock_noise = 0});
    m.levels.resize(2);
    for (double& seconds : m.levels[1].seconds) seconds *= 0.1;
    const TimeObservation time = fitted_time(m.levels, 0);
    EXPECT_GT(time.seconds_per_sample, 1e-9);
    EXPECT_EQ(time.seconds_per_point, 0);
}

/// Levels are timed at different moments; what lies between two of them took what they took.
TEST(Cost, MeasuredTimesLieBetweenTheTimesOfTheirLevels)
{
    CostMeasurements m = measured({.noise = 1e-4, .clock_noise = 1e-3});
    for (double& seconds : m.levels[2].seconds) seconds *= 1.5;  // 4 samples: 5 %
    const CostCurveReport curve = curve_report(m, ground_of_curve);
    const TimeToError& found = time_to(curve, 0.05);
    ASSERT_EQ(found.reach, Reach::measured);
    EXPECT_NEAR(found.seconds.value, curve.points[2].seconds.value,
                0.02 * curve.points[2].seconds.value);
    // And what lies beyond goes on from the longest level.
    for (double& seconds : m.levels[6].seconds) seconds *= 1.2;
    const CostCurveReport slower = curve_report(m, ground_of_curve);
    EXPECT_NEAR(time_to(slower, 0.005).seconds.value / time_to(curve, 0.005).seconds.value, 1.2,
                0.02);
}

/// As of sequences: steeper than the root, so the last level bounds what is beyond.
TEST(Cost, OfSequencesBoundsTimesBeyondTheLastLevel)
{
    CostMeasurements m = measured({.variance = 0.1, .noise = 1e-3, .clock_noise = 1e-3});
    for (CostLevel& level : m.levels) {
        level.spreads = level.squared_errors;
        for (std::vector<double>& replicate : level.squared_errors)
            for (double& square : replicate) square /= std::sqrt(double(level.samples));
        level.participation = {1e6, 1e6};
    }
    const CostCurveReport curve = curve_report(m, ground_of_curve);
    EXPECT_FALSE(curve.fits);
    const TimeToError& beyond = time_to(curve, 0.005);
    ASSERT_EQ(beyond.reach, Reach::at_most);
    const double last = curve.points.back().error.value;
    EXPECT_NEAR(beyond.samples, 64 * last * last / (0.005 * 0.005), 2);
    EXPECT_EQ(beyond.seconds.low, 0);
    EXPECT_GT(beyond.seconds.high, beyond.seconds.value);
    EXPECT_EQ(time_to(curve, 0.05).reach, Reach::measured);

    // Levels that few rare samples carry tell nothing: the first that is trusted bounds what it has
    // passed.
    for (std::size_t k = 0; k < 5; ++k) m.levels[k].participation = {1, 1};
    const CostCurveReport rare = curve_report(m, ground_of_curve);
    ASSERT_EQ(rare.points[5].trust, Trust::trusted);
    ASSERT_EQ(time_to(rare, 0.05).reach, Reach::at_most);
    EXPECT_EQ(time_to(rare, 0.05).samples, 32);
    for (CostLevel& level : m.levels) level.participation = {1, 1};
    EXPECT_EQ(time_to(curve_report(m, ground_of_curve), 0.005).reach, Reach::unknown);
}

TEST(Cost, BoundsNoErrorBelowWhatTheReferenceTells)
{
    const CostGround known{.points = 1000, .threads = 1, .reference = {1e-5, 1e-9, 1e-4}};
    const CostCurveReport curve =
        curve_report(measured({.variance = 1e-7, .reference = 1e-5, .noise = 1e-6}), known);
    for (const CostPoint& point : curve.points) {
        EXPECT_EQ(point.trust, Trust::below_reference);
        EXPECT_GE(point.error.high, 1e-2);
    }
}

TEST(Cost, IsSteeperInTimeWherePreparationIsLong)
{
    const CostCurveReport none = curve_report(measured({}), ground_of_curve),
                          much = curve_report(measured({.prepare = 1e-6}), ground_of_curve);
    EXPECT_NEAR(none.slope_in_time.value, -0.5, 0.02);
    EXPECT_LT(much.slope_in_time.high, -0.55);
    EXPECT_NEAR(much.slope.value, -0.5, 0.01);
}

TEST(Cost, EndsOnceTheSmallestErrorIsPassedOrTheReferenceTellsNoMore)
{
    const ReferenceError none, noisy{.squared = 1e-3, .se = 0, .floor = 1e-3};
    const SyntheticCurve precise{.variance = 1e-4};  // 0.5 % after 4 samples
    EXPECT_FALSE(tells_no_more(measured({}), none));
    EXPECT_TRUE(tells_no_more(measured(precise), none));
    SyntheticCurve short_one = precise;
    short_one.levels = 4;
    EXPECT_FALSE(tells_no_more(measured(short_one), none));
    EXPECT_TRUE(tells_no_more(measured({.reference = 1e-3}), noisy));
    EXPECT_FALSE(tells_no_more(measured({.reference = 1e-3, .levels = 5}), noisy));  // one alone
}

TEST(Cost, HasNoFiguresWithoutLevels)
{
    CostMeasurements none{.strategy = parse_strategy("brdf"), .reason = reason::NoTimeLeft{}};
    const CostCurveReport curve = curve_report(none, ground_of_curve);
    EXPECT_TRUE(curve.points.empty());
    EXPECT_TRUE(std::isnan(curve.seconds_per_sample.value));
    for (const TimeToError& t : curve.times) EXPECT_EQ(t.reach, Reach::unknown);
}

}  // namespace
}  // namespace mis
