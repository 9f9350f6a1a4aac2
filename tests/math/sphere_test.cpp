#include "mis/math/sphere.h"

#include "tests/support/lanes.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// The near hit in long double, from the impact parameter.
long double exact_distance(const Vec3<double>& c, double radius, const Vec3<double>& wi)
{
    using Long = glm::vec<3, long double>;
    const Long center = vec_cast<long double>(c), direction = vec_cast<long double>(wi);
    const long double r = static_cast<long double>(radius);
    const long double along = dot(center, direction), q2 = length2(cross(center, direction));
    return along - std::sqrt(r * r - q2);
}

/// A direction from the origin to a point of the sphere's disk, at `share` of its radius.
Vec3<double> towards_disk(const Vec3<double>& c, double radius, double share, Uniforms& uniforms)
{
    const Vec3<double> across = normalized(cross(c, uniforms.direction()));
    return normalized(c + across * (radius * share));
}

template <class T> void expect_distances(double tolerance, double direction_rounding)
{
    Uniforms uniforms(4);
    for (int i = 0; i < 20'000; ++i) {
        // Closer than a tenth of a radius, d itself is known to a rounding only: that takes d − r
        // from double.
        const double d = 10, radius = d / uniforms.log_between(1.1, 1e5);
        const Vec3<double> c = vec_cast<double>(vec_cast<T>(uniforms.direction() * d));
        // Nearer to the rim than a direction rounds, hit and miss are a matter of that rounding.
        const double share = std::max(0.0, 1 - 4 * direction_rounding * d / radius) * uniforms();
        const Vec3<double> wi =
            vec_cast<double>(vec_cast<T>(towards_disk(c, radius, share, uniforms)));
        const T found = hit_distance(vec_cast<T>(c), static_cast<T>(radius), vec_cast<T>(wi));
        const long double exact =
            exact_distance(c, static_cast<double>(static_cast<T>(radius)), wi);
        ASSERT_NEAR(static_cast<double>(found) / static_cast<double>(exact), 1, tolerance)
            << "d/r = " << d / radius << ", share = " << share;
    }
}

TEST(HitDistance, IsWithin1e5OfTheDistanceInFloat) { expect_distances<float>(1e-5, 6e-8); }
TEST(HitDistance, IsWithin1e11OfTheDistanceInDouble) { expect_distances<double>(1e-11, 1e-16); }

TEST(HitDistance, IsInfiniteBehindInsideAndBeside)
{
    const double miss = std::numeric_limits<double>::infinity();
    EXPECT_EQ(hit_distance(Vec3<double>{0, 0, -3}, 1.0, Vec3<double>{0, 0, 1}), miss);
    EXPECT_EQ(hit_distance(Vec3<double>{0, 0, 0.5}, 1.0, Vec3<double>{0, 0, 1}), miss);
    EXPECT_EQ(hit_distance(Vec3<double>{1.001, 0, 3}, 1.0, Vec3<double>{0, 0, 1}), miss);
    EXPECT_EQ(hit_distance(Vec3<double>{0, 0, 3}, 1.0, Vec3<double>{0, 0, 1}), 2);
}

TEST(HitDistance, LanesAgreeWithOneAtATime)
{
    using V = TestLanes<float>;
    Uniforms uniforms(5);
    for (int round = 0; round < 200; ++round) {
        std::array<Vec3<float>, lane_count<V>> c, wi;
        for (std::size_t i = 0; i < c.size(); ++i) {
            c[i] = vec_cast<float>(uniforms.in_box(3));
            wi[i] = vec_cast<float>(
                towards_disk(vec_cast<double>(c[i]), 1, 1.5 * uniforms(), uniforms));
        }
        const V found = hit_distance(vec_lanes_from<V>([&](std::size_t i) { return c[i]; }), V(1.F),
                                     vec_lanes_from<V>([&](std::size_t i) { return wi[i]; }));
        for (std::size_t i = 0; i < c.size(); ++i)
            EXPECT_EQ(lane(found, i), hit_distance(c[i], 1.F, wi[i]));
    }
}

}  // namespace
}  // namespace mis
