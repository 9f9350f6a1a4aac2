#include "mis/cost/stopping.h"

#include "tests/cost/synthetic_cost.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

constexpr ReferenceError none{};

TEST(CostStopping, OfAFixedNumberOfSamplesEndsThere)
{
    const CostMeasurements curve = measured({});
    EXPECT_FALSE(is_curve_done(curve, 32, 1e9, 0, {.spp = 64}, none));
    EXPECT_TRUE(is_curve_done(curve, 64, 0, 1e9, {.spp = 64}, none));
}

TEST(CostStopping, EndsWhereTheNextDoublingDoesNotFit)
{
    const CostMeasurements curve = measured({.levels = 4});
    EXPECT_FALSE(is_curve_done(curve, 8, 1, 2.3, {}, none));  // 2 s are within 90 % of them
    EXPECT_TRUE(is_curve_done(curve, 8, 1, 2.2, {}, none));
}

TEST(CostStopping, OfSequencesGoesOnToTwoHundredAndFiftySixSamples)
{
    const CostMeasurements precise = measured({.variance = 1e-4});
    ASSERT_TRUE(tells_no_more(precise, none));
    EXPECT_TRUE(is_curve_done(precise, 64, 0, 1e9, {}, none));
    EXPECT_FALSE(is_curve_done(precise, 64, 0, 1e9, {.is_sobol = true}, none));
    EXPECT_TRUE(is_curve_done(precise, 256, 0, 1e9, {.is_sobol = true}, none));
}

}  // namespace
}  // namespace mis
