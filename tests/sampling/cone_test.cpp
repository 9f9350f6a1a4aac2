#include "mis/sampling/cone.h"

#include "mis/math/sphere.h"

#include "tests/support/ends.h"
#include "tests/support/lanes.h"
#include "tests/support/quadrature.h"
#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

template <class T> class ConeOf : public testing::Test {
};
using NumberTypes = testing::Types<float, double>;
TYPED_TEST_SUITE(ConeOf, NumberTypes);

/// A sphere at distance 4 along `axis`, whose cap has this half-angle.
template <class T> Cap<T> cap_of_half_angle(double theta, const Vec3<double>& axis)
{
    const double d = 4, c = std::cos(theta);
    return cap_towards(vec_cast<T>(axis * d), static_cast<T>(d * std::sin(theta)),
                       static_cast<T>(d * d * c * c));
}

constexpr std::array half_angles{1e-8, 1e-4, 0.1, 1.0, 1.5707};
const Vec3<double> axis = normalized(Vec3<double>{0.3, -0.5, 0.8});

/// 1 − cos θ between the axis and the draw, from the offset: |offset|²/2, for unit vectors.
template <class T> double one_minus_cos_of(const CapDraw<T>& draw)
{
    return static_cast<double>(length2(vec_cast<double>(draw.offset))) / 2;
}

TYPED_TEST(ConeOf, DrawsAreUniformOverTheCap)
{
    using T = TypeParam;
    constexpr double false_alarm = 1e-6;  // for each half-angle and number type
    const int draws = scaled(200'000);
    constexpr int rings = 16, sectors = 16;
    for (const double theta : half_angles) {
        const Cap<T> cap = cap_of_half_angle<T>(theta, axis);
        const Frame<double> frame = frame_around(vec_cast<double>(cap.axis));
        const double whole = static_cast<double>(cap.one_minus_cos());
        std::vector<double> observed(rings * sectors),
            expected(rings * sectors, draws / double(rings * sectors));
        Uniforms uniforms(1);
        for (int i = 0; i < draws; ++i) {
            const Vec2<double> u = uniforms.pair();
            const CapDraw<T> draw =
                sample_cone(cap, Vec2<T>{static_cast<T>(u.x), static_cast<T>(u.y)});
            const Vec3<double> local = frame.to_local(vec_cast<double>(draw.offset));
            const double turn = std::atan2(local.y, local.x) / (2 * std::numbers::pi);
            const int ring =
                std::min(static_cast<int>(one_minus_cos_of(draw) / whole * rings), rings - 1);
            const int sector =
                std::min(static_cast<int>((turn < 0 ? turn + 1 : turn) * sectors), sectors - 1);
            ++observed[static_cast<std::size_t>(ring * sectors + sector)];
        }
        EXPECT_GT(chi2_p_value(observed, expected), false_alarm) << "half-angle " << theta;
    }
}

TYPED_TEST(ConeOf, DrawsStayInsideTheCapToTheRoundingOfADirection)
{
    using T = TypeParam;
    Uniforms uniforms(2);
    for (const double theta : half_angles)
        for (int i = 0; i < scaled(20'000); ++i) {
            const Cap<T> cap = cap_of_half_angle<T>(theta, uniforms.direction());
            Vec2<double> u = uniforms.pair();
            if (i % 4 == 0) u.x = 1 - 0x1p-24;  // the rim
            const CapDraw<T> draw =
                sample_cone(cap, Vec2<T>{static_cast<T>(u.x), static_cast<T>(u.y)});
            ASSERT_LE(one_minus_cos_of(draw) / static_cast<double>(cap.one_minus_cos()),
                      1 + 8 * ulp_of<T>)
                << theta;
            ASSERT_NEAR(static_cast<double>(length(draw.wi)), 1, 4 * ulp_of<T>);
            ASSERT_EQ(draw.wi, cap.axis + draw.offset);
        }
}

TYPED_TEST(ConeOf, TheDensityIsOneOverTheSolidAngleHoweverItIsWritten)
{
    using T = TypeParam;
    for (const double theta : half_angles) {
        const Cap<T> cap = cap_of_half_angle<T>(theta, axis);
        const CapDraw<T> draw = sample_cone(cap, Vec2<T>{T(0.3), T(0.7)});
        const double inverse =
            static_cast<double>(cap.sin_max * (cap.sin_max * draw.inverse_pdf_sin2));
        EXPECT_NEAR(inverse * static_cast<double>(cone_pdf(cap)), 1, 8 * ulp_of<T>);
        const double s = std::sin(theta / 2);
        EXPECT_NEAR(static_cast<double>(cone_pdf(cap)) * 4 * std::numbers::pi * s * s, 1,
                    20 * ulp_of<T>);
    }
}

/// 1/(pdf · sin²θ_max) times sin θ_max twice: the products are normal floats where the density is
/// infinite.
TEST(Cone, OfARadiusWhoseSquareIsNoFloatStillHasAFiniteIntegral)
{
    const Cap<float> cap = cap_towards(Vec3<float>{0, 2, 0}, 1e-20F, 4.F);
    const CapDraw<float> draw = sample_cone(cap, Vec2<float>{0.5F, 0.25F});
    const float radiance_radius = 1e18F;
    const float estimate = radiance_radius / cap.distance * (cap.sin_max * draw.inverse_pdf_sin2);
    EXPECT_NEAR(static_cast<double>(estimate), std::numbers::pi * 1e-2 / 4, 1e-8);
    EXPECT_EQ(static_cast<double>(draw.distance), 2);
}

/// The distance of a draw against the sphere itself, hit in double along axis + offset.
TYPED_TEST(ConeOf, TheDistanceIsWhereTheDrawMeetsTheSphere)
{
    using T = TypeParam;
    Uniforms uniforms(3);
    for (int i = 0; i < scaled(20'000); ++i) {
        const Vec3<double> to_center =
            vec_cast<double>(vec_cast<T>(uniforms.direction() * uniforms.between(1, 8)));
        const double d = length(to_center);
        const double radius =
            static_cast<double>(static_cast<T>(d * uniforms.log_between(1e-6, 0.999)));
        const Cap<T> cap = cap_towards(vec_cast<T>(to_center), static_cast<T>(radius),
                                       static_cast<T>(d * d - radius * radius));
        const Vec2<double> u = uniforms.pair();
        const CapDraw<T> draw =
            sample_cone(cap, Vec2<T>{static_cast<T>(u.x * 0.999), static_cast<T>(u.y)});
        const double exact = hit_distance(
            to_center, radius, normalized(normalized(to_center) + vec_cast<double>(draw.offset)));
        ASSERT_NEAR(static_cast<double>(draw.distance), exact,
                    60 * ulp_of<T> * exact + 100 * ulp_of<T> * d)
            << "d/r = " << d / radius;
    }
}

/// ∫ cos θ over a cap above the horizon is π sin²θ_max cos β, by nodes in place of random numbers.
TYPED_TEST(ConeOf, NodesInPlaceOfRandomNumbersGiveTheClosedFormIrradiance)
{
    using T = TypeParam;
    const UnitNodes<16> rule;
    const Vec3<double> n = normalized(Vec3<double>{0.1, -0.6, 1});
    for (const double theta : {1e-8, 1e-6, 1e-3, 0.1, 0.5, 1.0}) {
        const Cap<T> cap = cap_of_half_angle<T>(theta, axis);
        double sum = 0;
        for (std::size_t a = 0; a < rule.node.size(); ++a)
            for (std::size_t b = 0; b < rule.node.size(); ++b) {
                const Vec2<T> u{static_cast<T>(rule.node[a]), static_cast<T>(rule.node[b])};
                const CapDraw<T> draw = sample_cone(cap, u);
                sum += rule.weight[a] * rule.weight[b] * dot(vec_cast<double>(draw.wi), n) *
                       static_cast<double>(draw.inverse_pdf_sin2);
            }
        EXPECT_NEAR(sum / (std::numbers::pi * dot(axis, n)), 1, sizeof(T) == 4 ? 1e-6 : 1e-12)
            << theta;
    }
}

/// Of a cap that is all above the horizon no draw is worth 0; of one that is cut, those are that
/// the horizon cuts off.
TYPED_TEST(ConeOf, DrawsKnowOnWhichSideOfTheHorizonTheyAre)
{
    using T = TypeParam;
    const std::vector<Vec2<T>> ends = ends_of_square<T>(scaled(16), 2);
    const Vec3<double> tilt = normalized(Vec3<double>{0.3, -0.5, 0.8});
    for (const Vec3<double>& up : {Vec3<double>{0, 0, 1}, tilt})
        for (const double sine : {1e-8, 1e-4, 0.1, 0.5, 0.9, 0.999, 1 - 5e-9})
            for (const double height : {3.0, 1 + 1e-6, 1.0, 0.5, 0.0, -0.5, -1 + 1e-6, -1.5}) {
                const double c = height * sine;
                if (std::abs(c) > 1) continue;
                const Vec3<double> towards =
                    frame_around(up).to_world({std::sqrt((1 - c) * (1 + c)), 0, c});
                const Cap<T> cap = cap_towards(vec_cast<T>(towards * 4.0), static_cast<T>(4 * sine),
                                               static_cast<T>(16 * (1 - sine) * (1 + sine)));
                const auto n = vec_cast<T>(up);
                const bool is_above = dot(n, cap.axis) >= cap.sin_max;
                for (const Vec2<T>& u : ends) {
                    const CapDraw<T> draw = sample_cone_over(cap, n, u);
                    const double exact = dot(vec_cast<double>(n), vec_cast<double>(cap.axis)) +
                                         dot(vec_cast<double>(n), vec_cast<double>(draw.offset));
                    const double sum = up.x == 0 ? std::abs(c) + sine : 1;  // of what is added
                    const double near = 4 * ulp_of<T> * sum;
                    ASSERT_NEAR(static_cast<double>(draw.cos_theta), exact, near)
                        << sine << ", " << height << ": " << u.x << ", " << u.y;
                    if (is_above) {
                        ASSERT_GT(draw.cos_theta, 0);
                    }
                    if (draw.cos_theta > 0) {
                        ASSERT_GT(frame_around(n).to_local(draw.wi).z, 0);
                    }
                    ASSERT_TRUE(std::isfinite(draw.distance) && draw.distance > 0);
                    ASSERT_NEAR(static_cast<double>(length(draw.wi)), 1, 10 * ulp_of<T>);
                }
            }
}

template <class V> void expect_lanes_agree()
{
    using S = Scalar<V>;
    Uniforms uniforms(4);
    for (int round = 0; round < 1000; ++round) {
        std::array<Vec3<S>, lane_count<V>> c;
        std::array<S, lane_count<V>> r, u, v;
        for (std::size_t i = 0; i < c.size(); ++i) {
            c[i] = vec_cast<S>(uniforms.direction() * 3.0);
            r[i] = static_cast<S>(uniforms.log_between(1e-8, 2.9));
            u[i] = static_cast<S>(uniforms() * 0.999), v[i] = static_cast<S>(uniforms());
        }
        const V radius = load_lanes<V>(r.data());
        const Vec3<V> center = vec_lanes_from<V>([&](std::size_t i) { return c[i]; });
        const V gap2 = V(S(9)) - radius * radius;
        const CapDraw<V> draws =
            sample_cone(cap_towards(center, radius, gap2),
                        Vec2<V>{load_lanes<V>(u.data()), load_lanes<V>(v.data())});
        for (std::size_t i = 0; i < c.size(); ++i) {
            const CapDraw<S> one =
                sample_cone(cap_towards(c[i], r[i], lane(gap2, i)), Vec2<S>{u[i], v[i]});
            const double span = static_cast<double>(length(one.offset));
            ASSERT_NEAR(static_cast<double>(length(lane(draws.offset, i) - one.offset)), 0,
                        20 * ulp_of<V> * span);
            ASSERT_NEAR(static_cast<double>(lane(draws.distance, i) / one.distance), 1,
                        40 * ulp_of<V>);
        }
    }
}

TEST(Cone, LanesAgreeWithOneAtATime)
{
    expect_lanes_agree<TestLanes<float>>();
    expect_lanes_agree<TestLanes<double>>();
}

}  // namespace
}  // namespace mis
