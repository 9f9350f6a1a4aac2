#include "mis/cost/crossings.h"

#include "tests/cost/synthetic_cost.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

constexpr CostGround ground{.points = 1000, .threads = 2, .reference = {}};

std::vector<CrossingReport> crossings_of(std::initializer_list<SyntheticCurve> curves)
{
    std::vector<CostModel> models;
    for (const SyntheticCurve& c : curves) models.push_back(model_of(measured(c), ground));
    return find_crossings(models);
}

const SyntheticCurve quick{.variance = 0.2, .per_sample = 1e-7, .seed = 1};
const SyntheticCurve thorough{.variance = 0.1, .prepare = 2e-6, .per_sample = 1e-7, .seed = 2};

TEST(CostCrossings, AreWherePreparationIsPaidBack)
{
    // 0.2/e² · 1e-7 = 2e-6 + 0.1/e² · 1e-7: at e² = 0.005, after 500 · 4e-6 s.
    const std::vector<CrossingReport> found = crossings_of({quick, thorough});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].before, 0);
    EXPECT_EQ(found[0].after, 1);
    EXPECT_NEAR(found[0].error.value, std::sqrt(0.005), 0.004);
    EXPECT_NEAR(found[0].seconds.value, 2e-3, 1e-4);
    EXPECT_LE(found[0].seconds.low, 2e-3);
    EXPECT_GE(found[0].seconds.high, 2e-3);
    EXPECT_LE(found[0].error.low, found[0].error.value);
    EXPECT_GE(found[0].error.high, found[0].error.value);
    EXPECT_FALSE(found[0].is_extrapolated);
}

TEST(CostCrossings, NameTheQuickerOneFirstWhateverTheOrder)
{
    const std::vector<CrossingReport> found = crossings_of({thorough, quick});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].before, 1);
    EXPECT_EQ(found[0].after, 0);
}

TEST(CostCrossings, AreMarkedBeyondWhatWasMeasured)
{
    SyntheticCurve short_quick = quick, short_thorough = thorough;
    short_quick.levels = short_thorough.levels = 4;  // down to 11 % and 16 %
    const std::vector<CrossingReport> found = crossings_of({short_quick, short_thorough});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_TRUE(found[0].is_extrapolated);
}

TEST(CostCrossings, AreNotReportedUnlessBothSidesAreSure)
{
    SyntheticCurve unsure = thorough;
    unsure.variance = 0.19, unsure.noise = 1;  // ahead in the end, but who can tell
    EXPECT_TRUE(crossings_of({quick, unsure}).empty());
}

TEST(CostCrossings, DoNotExistBetweenParallelsOrWhereOneAlwaysLeads)
{
    SyntheticCurve parallel = quick, worse = thorough;
    parallel.seed = 3;
    worse.variance = 0.4;
    EXPECT_TRUE(crossings_of({quick, parallel}).empty());
    EXPECT_TRUE(crossings_of({quick, worse}).empty());
}

TEST(CostCrossings, AreNotWhereOneHasLessThanASample)
{
    // The second is 20 times as dear and errs by 10 % at once; before, it has nothing to show.
    const SyntheticCurve at_once{.variance = 0.01, .per_sample = 2e-6, .seed = 4};
    EXPECT_TRUE(crossings_of({{.variance = 0.5}, at_once}).empty());
}

TEST(CostCrossings, LeaveOutCurvesWithoutAFit)
{
    SyntheticCurve rare = thorough;
    rare.carriers = 10;
    EXPECT_TRUE(crossings_of({quick, rare}).empty());
    EXPECT_TRUE(crossings_of({}).empty());
}

}  // namespace
}  // namespace mis
