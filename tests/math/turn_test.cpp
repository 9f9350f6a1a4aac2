#include "mis/math/turn.h"

#include "tests/support/lanes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mis {
namespace {

/// The largest distance from the circle's point in long double, over an even grid of u and a fine
/// one about each quarter, in units of the last place of 1.
template <class T> double worst_in_ulps()
{
    long double worst = 0;
    const auto look_at = [&](T u) {
        if (!(u >= 0 && u <= 1)) return;
        const long double phi = 2 * std::numbers::pi_v<long double> * static_cast<long double>(u);
        const OnCircle<T> at = on_circle(u);
        worst = std::max({worst, std::abs(static_cast<long double>(at.cos) - std::cos(phi)),
                          std::abs(static_cast<long double>(at.sin) - std::sin(phi))});
    };
    for (int i = 0; i <= 100'000; ++i) look_at(static_cast<T>(i) / T(100'000));
    for (int quarter = 0; quarter <= 4; ++quarter)
        for (double gap = 1e-12; gap < 0.1; gap *= 1.3)
            for (const double side : {-gap, gap}) look_at(static_cast<T>(quarter / 4.0 + side));
    return static_cast<double>(worst / static_cast<long double>(std::numeric_limits<T>::epsilon()));
}

TEST(OnCircle, IsRightToTwoUnitsInTheLastPlaceOfOne)
{
    EXPECT_LT(worst_in_ulps<float>(), 2);
    EXPECT_LT(worst_in_ulps<double>(), 2);
}

TEST(OnCircle, KeepsTheDigitsOfASmallAngle)
{
    for (const double u : {1e-30, 1e-12, 1e-6}) {
        const double sin = std::sin(2 * std::numbers::pi * u);
        EXPECT_NEAR(static_cast<double>(on_circle(static_cast<float>(u)).sin), sin, 3e-7 * sin);
        EXPECT_NEAR(on_circle(u).sin, sin, 1e-15 * sin);
    }
}

TEST(OnCircle, IsExactWhereWholeTurnsMeet)
{
    EXPECT_EQ(on_circle(0.0F).sin, 0.0F);
    EXPECT_EQ(on_circle(0.5).sin, 0.0);
    EXPECT_EQ(on_circle(1.0F).sin, on_circle(0.0F).sin);
    EXPECT_EQ(on_circle(1.0).cos, on_circle(0.0).cos);
}

}  // namespace
}  // namespace mis
