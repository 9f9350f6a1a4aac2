#include "mis/sampling/projected.h"

#include "mis/math/sphere.h"

#include "tests/support/ends.h"
#include "tests/support/irradiance.h"
#include "tests/support/lanes.h"
#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace mis {
namespace {

template <class T> class ProjectedOf : public testing::Test {
};
using NumberTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(ProjectedOf, NumberTypes);

/// Half-angles, by their sines, from 1e-8 rad to a hemisphere less 1e-4 rad.
constexpr std::array sines{1e-8, 1e-4, 0.1, 0.5, 0.9, 0.999, 1 - 5e-9};
/// cos β over sin θ_max: all above the horizon, half, hardly any.
constexpr std::array heights{1.0, 0.999, 0.5, 0.01, 0.0, -0.01, -0.5, -0.9, -0.999};

/// A sphere at distance 4 whose cap has this sine, and whose centre this height over it.
template <class T> Cap<T> cap_over_horizon(double sin_max, double height, double phi)
{
    const double c = height * sin_max, flat = std::sqrt((1 - c) * (1 + c));
    const Vec3<double> axis{flat * std::cos(phi), flat * std::sin(phi), c};
    return cap_towards(vec_cast<T>(axis * 4.0), static_cast<T>(4 * sin_max),
                       static_cast<T>(16 * (1 - sin_max) * (1 + sin_max)));
}
template <class T> const Vec3<T> up{T(0), T(0), T(1)};

using Exact = boost::multiprecision::cpp_bin_float_100;

/// The area of a lune from ordinate y to its end, by the textbook's integrals of both edges, in a
/// hundred digits. m: |cos β|.
Exact lune_beyond(const Exact& y, const Exact& s, const Exact& m)
{
    const Exact x0 = sqrt((1 - s * s) * (1 - m * m));
    const Exact y_end = sqrt(s * s - m * m) / sqrt(1 - m * m);
    const auto up_to = [&](const Exact& v) -> Exact {
        const Exact circle = (v * sqrt(1 - v * v) + asin(v)) / 2;
        const Exact ellipse = m * (v * sqrt(s * s - v * v) + s * s * asin(v / s)) / 2;
        return circle - x0 * v - ellipse;
    };
    return up_to(y_end) - up_to(y < y_end ? y : y_end);
}

/// A slice that is to leave a share of the area on one side does so.
TYPED_TEST(ProjectedOf, SlicesOfTheLuneCutOffTheShareOfTheAreaThatIsAskedFor)
{
    using T = TypeParam;
    constexpr double tolerance = sizeof(T) == 4 ? 1e-5 : 3e-6;
    for (const double sine : sines)
        for (const double height : heights) {
            if (height >= 1) continue;
            const auto s = static_cast<T>(sine), c = static_cast<T>(height * sine);
            const auto other = [](T x) { return std::sqrt((1 - x) * (1 + x)); };
            const TiltedCap<T> cap{s, other(s), c, other(c)};
            const detail::Lune<T> lune(cap, detail::chord2(cap));
            const Exact exact_s = s, m = abs(Exact(c)), half = lune_beyond(0, exact_s, m);
            for (const double share :
                 {1e-9, 1e-6, 1e-3, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0}) {
                const T p = lune.position_of(static_cast<T>(share));
                const T across = lune.point(p, T(1), T(0.5), c / s).offset.y;
                const Exact found = lune_beyond(Exact(across) * exact_s, exact_s, m) / half;
                ASSERT_NEAR(static_cast<double>(found), share, tolerance)
                    << "s = " << sine << ", height " << height;
            }
        }
}

/// Where the cap's rim is, and the horizon: no draw is beyond either.
TYPED_TEST(ProjectedOf, DrawsStayInsideTheCapAndAboveTheHorizon)
{
    using T = TypeParam;
    Uniforms uniforms(1);
    for (const double sine : sines)
        for (const double height : heights)
            for (int i = 0; i < scaled(2000); ++i) {
                const Cap<T> cap = cap_over_horizon<T>(sine, height, uniforms.between(0, 6));
                Vec2<double> u = uniforms.pair();
                if (i % 4 == 0) u.x = i % 8 == 0 ? 1 - 0x1p-24 : 0;
                if (i % 16 < 4) u.y = i % 3 == 0 ? 1 - 0x1p-24 : 0;
                const CapDraw<T> draw =
                    sample_projected(cap, up<T>, Vec2<T>{static_cast<T>(u.x), static_cast<T>(u.y)});
                const double one_minus_cos =
                    static_cast<double>(length2(vec_cast<double>(draw.offset))) / 2;
                ASSERT_LE(one_minus_cos / static_cast<double>(cap.one_minus_cos()),
                          1 + 16 * ulp_of<T>)
                    << sine << ", " << height;
                const double cos_theta =
                    static_cast<double>(cap.axis.z) + static_cast<double>(draw.offset.z);
                ASSERT_GE(cos_theta / static_cast<double>(cap.sin_max), -8 * ulp_of<T>)
                    << sine << ", " << height;
                ASSERT_NEAR(static_cast<double>(length(draw.wi)), 1, 10 * ulp_of<T>);
            }
}

/// A cap turned so that the horizon of a tilted normal cuts it as that of (0, 0, 1) did.
template <class T> Cap<T> turned(const Cap<T>& cap, const Vec3<double>& n)
{
    Cap<T> other = cap;
    other.axis = vec_cast<T>(frame_around(n).to_world(vec_cast<double>(cap.axis)));
    return other;
}

/// n·wi > 0 however it is added up, and in the frame of n.
template <class T> bool is_surely_above(const Vec3<T>& wi, const Vec3<T>& n)
{
    const T x = n.x * wi.x, y = n.y * wi.y, z = n.z * wi.z;
    return (x + y) + z > 0 && (y + z) + x > 0 && (z + x) + y > 0 &&
           frame_around(n).to_local(wi).z > 0;
}

/// Of a surface that scatters alike in all directions a draw is worth the irradiance, and is above
/// the horizon. True where there was something to draw.
template <class T>
void expect_worth_the_irradiance(const Cap<T>& cap, const Vec3<T>& n, const Vec2<T>& u)
{
    const TiltedCap<T> seen = tilted(cap, n);
    const double known = static_cast<double>(irradiance_over_sin2(seen));
    const CapDraw<T> draw = sample_projected(cap, n, u);
    ASSERT_GT(draw.cos_theta, 0);
    ASSERT_TRUE(is_surely_above(draw.wi, n));
    ASSERT_TRUE(std::isfinite(draw.distance) && draw.distance > 0);
    ASSERT_NEAR(static_cast<double>(length(draw.wi)), 1, 10 * ulp_of<T>);
    ASSERT_NEAR(static_cast<double>(draw.inverse_pdf_sin2 * draw.cos_theta) / known, 1,
                2 * ulp_of<T>);
    const double inverse = static_cast<double>(cap.sin_max * (cap.sin_max * draw.inverse_pdf_sin2));
    ASSERT_NEAR(inverse * static_cast<double>(projected_pdf(cap, n, draw.cos_theta)), 1,
                8 * ulp_of<T>);
    // The cosine is that of the direction.
    const double cos_theta =
        static_cast<double>(seen.cos_beta) + static_cast<double>(dot(n, draw.offset));
    ASSERT_NEAR(static_cast<double>(draw.cos_theta), cos_theta,
                16 * ulp_of<T> * static_cast<double>(cap.sin_max + std::abs(seen.cos_beta)));
}

/// body(cap, normal, what) for caps whose rim is far above the horizon, touches it, is cut by it,
/// and shows a millionth of itself; over a normal along an axis, and a tilted one.
template <class T, class Body> void for_each_cap(const Body& body)
{
    std::vector<double> all(heights.begin(), heights.end());
    all.insert(all.end(), {3.0, 1 + 1e-6, -1 + 1e-6});
    const Vec3<double> tilt = normalized(Vec3<double>{0.3, -0.5, 0.8});
    for (const double sine : sines)
        for (const double height : all) {
            if (height * sine > 1) continue;
            const Cap<T> cap = cap_over_horizon<T>(sine, height, 0.7);
            const std::string what = std::to_string(sine) + ", " + std::to_string(height);
            body(cap, up<T>, what);
            body(turned(cap, tilt), vec_cast<T>(tilt), what + ", tilted");
        }
}

TYPED_TEST(ProjectedOf, EveryDrawIsWorthTheIrradiance)
{
    using T = TypeParam;
    Uniforms uniforms(2);
    int caps = 0;
    for_each_cap<T>([&](const Cap<T>& cap, const Vec3<T>& n, const std::string& what) {
        if (!(irradiance_over_sin2(tilted(cap, n)) > 0)) return;  // rounded to below the horizon
        ++caps;
        SCOPED_TRACE(what);
        for (int i = 0; i < 200; ++i) {
            const Vec2<double> u = uniforms.pair();
            expect_worth_the_irradiance(cap, n, Vec2<T>{static_cast<T>(u.x), static_cast<T>(u.y)});
        }
    });
    EXPECT_GE(caps, 130);
}

TYPED_TEST(ProjectedOf, NoDrawIsLostAtTheEndsOfItsNumbers)
{
    using T = TypeParam;
    const std::vector<Vec2<T>> ends = ends_of_square<T>(scaled(32), 2);
    for_each_cap<T>([&](const Cap<T>& cap, const Vec3<T>& n, const std::string& what) {
        if (!(irradiance_over_sin2(tilted(cap, n)) > 0)) return;
        SCOPED_TRACE(what);
        for (const Vec2<T>& u : ends) {
            expect_worth_the_irradiance(cap, n, u);
            if (testing::Test::HasFatalFailure()) FAIL() << u.x << ", " << u.y;
        }
    });
}

/// In 10⁷ draws of a lamp half in the floor some used to fall on the horizon itself.
TYPED_TEST(ProjectedOf, NoDrawOfALampHalfInTheFloorIsLost)
{
    using T = TypeParam;
    Uniforms uniforms(1);  // of these numbers, three were lost in float
    for (int i = 0; i < scaled(10'000'000); ++i) {
        const double d = uniforms.between(0.6, 20), r = 0.5;
        const Vec3<double> to_center{std::sqrt(d * d - 0.04), 0, 0.2};
        const Cap<T> cap = cap_towards(vec_cast<T>(to_center), static_cast<T>(r),
                                       static_cast<T>((d - r) * (d + r)));
        const Vec2<double> u = uniforms.pair();
        const CapDraw<T> draw =
            sample_projected(cap, up<T>, Vec2<T>{static_cast<T>(u.x), static_cast<T>(u.y)});
        ASSERT_GT(draw.wi.z, 0) << u.x << ", " << u.y << ", " << d;
        ASSERT_GT(draw.cos_theta, 0);
    }
}

/// A cap below the horizon is not drawn, and has no density.
TYPED_TEST(ProjectedOf, ACapBelowTheHorizonHasNoDraws)
{
    using T = TypeParam;
    for (const double sine : {1e-8, 0.1, 0.9}) {
        const Cap<T> cap = cap_over_horizon<T>(sine, -1.001, 2);
        for (const T u : {T(0), T(0.3), T(0.9)}) {
            const CapDraw<T> draw = sample_projected(cap, up<T>, Vec2<T>{u, T(1) - u});
            EXPECT_EQ(draw.inverse_pdf_sin2, 0);
            EXPECT_EQ(draw.cos_theta, 0);
            EXPECT_TRUE(std::isfinite(length(draw.offset)) && std::isfinite(draw.distance));
        }
        EXPECT_EQ(projected_pdf(cap, up<T>, T(0.1)), 0);
    }
    const Cap<T> above = cap_over_horizon<T>(0.1, 0.5, 2);
    EXPECT_GT(projected_pdf(above, up<T>, T(0.01)), 0);
    EXPECT_EQ(projected_pdf(above, up<T>, T(-0.01)), 0);
}

/// The distance of a draw against the sphere itself, hit in double along axis + offset.
TYPED_TEST(ProjectedOf, TheDistanceIsWhereTheDrawMeetsTheSphere)
{
    using T = TypeParam;
    Uniforms uniforms(3);
    for (int i = 0; i < scaled(20'000); ++i) {
        const double sine = uniforms.log_between(1e-6, 0.99);
        const Cap<T> cap = cap_over_horizon<T>(sine, uniforms.between(-0.9, 1.5), 1);
        if (!(cap.axis.z <= T(1))) continue;
        const Vec2<double> u = uniforms.pair();
        const CapDraw<T> draw =
            sample_projected(cap, up<T>, Vec2<T>{static_cast<T>(u.x), static_cast<T>(u.y)});
        const Vec3<double> axis = normalized(vec_cast<double>(cap.axis));
        const Vec3<double> wi = normalized(axis + vec_cast<double>(draw.offset));
        const double radius = static_cast<double>(cap.radius),
                     d = static_cast<double>(cap.distance);
        const double q = length(cross(axis, wi)) * d / radius;
        if (q > 0.999) continue;  // at the rim the distance is all rounding
        const double exact = hit_distance(axis * d, radius, wi);
        ASSERT_NEAR(static_cast<double>(draw.distance) / exact, 1, 2000 * ulp_of<T>)
            << "sin_max = " << sine;
    }
}

template <class V> void expect_lanes_project_alike()
{
    using S = Scalar<V>;
    Uniforms uniforms(4);
    for (int round = 0; round < 1000; ++round) {
        std::array<Cap<S>, lane_count<V>> cap;
        std::array<Vec2<S>, lane_count<V>> u;
        for (std::size_t i = 0; i < cap.size(); ++i) {
            const double sin_max = uniforms.log_between(1e-6, 0.99);
            cap[i] =
                cap_over_horizon<S>(sin_max, uniforms.between(-0.99, 1.5) < 0 ? -0.5 : 1.01, 1);
            if (i % 2 == 0) cap[i] = cap_over_horizon<S>(0.3, uniforms.between(-0.9, 0.9), 2);
            u[i] = {static_cast<S>(uniforms()), static_cast<S>(uniforms())};
        }
        const auto lanes = [&](S Cap<S>::*field) {
            return lanes_from<V>([&](std::size_t i) { return cap[i].*field; });
        };
        using C = Cap<S>;
        const Cap<V> caps{vec_lanes_from<V>([&](std::size_t i) { return cap[i].axis; }),
                          lanes(&C::distance),
                          lanes(&C::radius),
                          lanes(&C::gap2),
                          lanes(&C::sin_max),
                          lanes(&C::inverse_one_plus_cos),
                          lanes(&C::inverse_distance)};
        const Vec2<V> both{lanes_from<V>([&](std::size_t i) { return u[i].x; }),
                           lanes_from<V>([&](std::size_t i) { return u[i].y; })};
        const Vec3<V> n{V(S(0)), V(S(0)), V(S(1))};
        const CapDraw<V> draws = sample_projected(caps, n, both);
        for (std::size_t i = 0; i < cap.size(); ++i) {
            const CapDraw<S> one = sample_projected(cap[i], up<S>, u[i]);
            ASSERT_NEAR(static_cast<double>(length(lane(draws.offset, i) - one.offset)), 0,
                        1e4 * ulp_of<V> * static_cast<double>(cap[i].sin_max));
            ASSERT_NEAR(static_cast<double>(lane(draws.distance, i) / one.distance), 1,
                        1e4 * ulp_of<V>);
        }
    }
}

TEST(Projected, LanesAgreeWithOneAtATime)
{
    expect_lanes_project_alike<TestLanes<float>>();
    expect_lanes_project_alike<TestLanes<double>>();
}

}  // namespace
}  // namespace mis
