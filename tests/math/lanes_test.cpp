#include "tests/support/lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mis {
namespace {

template <class T> class EveryLanes : public testing::Test {
};
using LaneTypes = testing::Types<float, double, TestLanes<float>, TestLanes<double>>;
TYPED_TEST_SUITE(EveryLanes, LaneTypes);

TYPED_TEST(EveryLanes, StoreUndoesLoadAtAnyAddress)
{
    using S = Scalar<TypeParam>;
    std::array<S, 40> from{}, to{};
    for (std::size_t i = 0; i < from.size(); ++i) from[i] = static_cast<S>(i) + S(0.5);
    store_lanes(&to[1], load_lanes<TypeParam>(&from[3]));
    for (std::size_t i = 0; i < lane_count<TypeParam>; ++i) EXPECT_EQ(to[1 + i], from[3 + i]);
    EXPECT_EQ(to[1 + lane_count<TypeParam>], 0);
}

TYPED_TEST(EveryLanes, SelectTakesEachLaneFromItsOwnSide)
{
    using T = TypeParam;
    using S = Scalar<T>;
    const T x = lanes_from<T>([](std::size_t i) { return static_cast<S>(i % 2); });
    const T chosen = select(x > T(S(0.5)), T(S(7)), T(S(9)));
    for (std::size_t i = 0; i < lane_count<T>; ++i) EXPECT_EQ(lane(chosen, i), i % 2 == 1 ? 7 : 9);
}

TYPED_TEST(EveryLanes, ABoundReplacesWhatIsNoNumber)
{
    using T = TypeParam;
    using S = Scalar<T>;
    const T nan(std::numeric_limits<S>::quiet_NaN());
    EXPECT_EQ(lane(max_of(nan, T(S(2))), 0), 2);
    EXPECT_EQ(lane(min_of(nan, T(S(2))), 0), 2);
    EXPECT_EQ(lane(max_of(T(S(3)), T(S(2))), 0), 3);
    EXPECT_EQ(lane(min_of(T(S(3)), T(S(2))), 0), 2);
}

/// Lanes bring sine and cosine of their own.
TYPED_TEST(EveryLanes, SineAndCosineAreRightToThreeRoundingsOverATurn)
{
    using std::cos, std::sin;
    using T = TypeParam;
    using S = Scalar<T>;
    for (int i = 0; i <= 1000; ++i) {
        const S phi = static_cast<S>(6.2831 * i / 1000);
        const auto exact = static_cast<double>(phi);
        EXPECT_NEAR(static_cast<double>(lane(T(sin(T(phi))), 0)), std::sin(exact), 3 * ulp_of<T>);
        EXPECT_NEAR(static_cast<double>(lane(T(cos(T(phi))), 0)), std::cos(exact), 3 * ulp_of<T>);
    }
}

}  // namespace
}  // namespace mis
