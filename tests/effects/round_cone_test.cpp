#include "mis/effects/round_cone.h"

#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mis {
namespace {

/// The hull is the union of the balls between the two, so p is as far from it as from the nearest.
double distance_to_balls(const Vec3<double>& from, double from_radius, const Vec3<double>& to,
                         double to_radius, const Vec3<double>& p)
{
    constexpr int steps = 20'000;
    double least = 1e300;
    for (int i = 0; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        least = std::min(least, length(p - (from + (to - from) * t)) -
                                    (from_radius + (to_radius - from_radius) * t));
    }
    return least;
}

TEST(RoundCone, DistanceIsThatOfTheNearestBallBetween)
{
    Uniforms uniforms(71);
    int sides = 0;
    for (int k = 0; k < 400; ++k) {
        const Vec3<double> from = uniforms.in_box(2), to = uniforms.in_box(2),
                           p = uniforms.in_box(4);
        const double r0 = k % 5 == 0 ? 0 : uniforms.log_between(1e-3, 2),
                     r1 = k % 5 == 1 ? r0 : uniforms.log_between(1e-3, 2);
        const double found = RoundCone(from, r0, to, r1).distance(p),
                     expected = distance_to_balls(from, r0, to, r1, p);
        EXPECT_NEAR(found, expected, 1e-6) << k;
        sides += std::min(length(p - from) - r0, length(p - to) - r1) > expected + 1e-3 ? 1 : 0;
    }
    EXPECT_GT(sides, 50);  // where neither end is nearest
}

TEST(RoundCone, OfBallsInOnePlaceIsTheLargerBall)
{
    const Vec3<double> c{1, 2, 3}, p{1, 2, 8};
    EXPECT_EQ(RoundCone(c, 1, c, 2).distance(p), 3);
    EXPECT_EQ(RoundCone(c, 2, c, 1).distance(p), 3);
    EXPECT_EQ(RoundCone(c, 1, c, 1).distance(p), 4);
    EXPECT_EQ(RoundCone(c, 5, {1, 2, 4}, 1).distance(p), 0);  // one holds the other
}

}  // namespace
}  // namespace mis
