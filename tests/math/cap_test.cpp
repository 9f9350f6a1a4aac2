#include "mis/math/cap.h"

#include "tests/support/lanes.h"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace mis {
namespace {

/// 2π(1 − cos θ) in long double, by half angles: nothing cancels.
long double solid_angle_of(long double theta)
{
    const long double s = std::sin(theta / 2);
    return 4 * std::numbers::pi_v<long double> * s * s;
}

/// A sphere at distance 3 that covers a cap of half-angle θ; d² − r² is exact but for its last
/// rounding.
template <class T> Cap<T> cap_of_half_angle(double theta)
{
    const double d = 3, c = std::cos(theta);
    const Vec3<double> axis{2.0 / 3, 2.0 / 3, 1.0 / 3};
    return cap_towards(vec_cast<T>(axis * d), static_cast<T>(d * std::sin(theta)),
                       static_cast<T>(d * d * c * c));
}

template <class T> void expect_solid_angles(double tolerance)
{
    std::vector<double> angles{1.569051};  // 89.9°
    for (double theta = 1e-18; theta < 1.5700; theta = std::min(theta * 1.3, theta + 0.01))
        angles.push_back(theta);
    for (const double theta : angles) {
        const auto exact = static_cast<double>(solid_angle_of(static_cast<long double>(theta)));
        const Cap<T> cap = cap_of_half_angle<T>(theta);
        EXPECT_NEAR(static_cast<double>(cap.solid_angle()) / exact, 1, tolerance)
            << "theta = " << theta;
    }
}

TEST(Cap, SolidAngleIsRightFrom1e18RadiansToNearlyAHemisphereInFloat)
{
    expect_solid_angles<float>(1e-6);
}

TEST(Cap, SolidAngleIsRightInDouble) { expect_solid_angles<double>(1e-14); }

TEST(Cap, LanesAgreeWithOneAtATime)
{
    using V = TestLanes<float>;
    const auto theta = [](std::size_t i) { return std::pow(10.0, -static_cast<double>(i)); };
    const V radius =
        lanes_from<V>([&](std::size_t i) { return static_cast<float>(2 * std::sin(theta(i))); });
    const V gap2 = lanes_from<V>(
        [&](std::size_t i) { return static_cast<float>(4 * std::pow(std::cos(theta(i)), 2)); });
    const Cap<V> caps = cap_towards(Vec3<V>{V(0.F), V(2.F), V(0.F)}, radius, gap2);
    for (std::size_t i = 0; i < lane_count<V>; ++i) {
        const Cap<float> one = cap_towards(Vec3<float>{0, 2, 0}, lane(radius, i), lane(gap2, i));
        EXPECT_NEAR(lane(caps.solid_angle(), i) / one.solid_angle(), 1, 4 * ulp_of<V>);
    }
}

/// A point a millionth of a radius above a sphere of radius 1: the cap is nearly a hemisphere.
TEST(Cap, OfASphereClosebyKeepsItsDigitsInDouble)
{
    const long double h = 1e-6L, d = 1 + h, gap2 = h * (2 + h);
    const long double exact = 2 * std::numbers::pi_v<long double> * (1 - std::sqrt(gap2) / d);
    const double found =
        cap_of_sphere(Vec3<double>{0, 1 + 1e-6, 0}, 1.0, Vec3<double>{0, 0, 0}).solid_angle();
    EXPECT_NEAR(found / static_cast<double>(exact), 1, 1e-12);
}

}  // namespace
}  // namespace mis
