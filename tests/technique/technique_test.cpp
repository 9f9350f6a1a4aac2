// What is true of every technique of the registry.
#include "mis/technique/technique.h"

#include "mis/bsdf/registry.h"
#include "mis/math/sphere.h"
#include "mis/technique/registry.h"

#include "tests/support/lanes.h"
#include "tests/support/polar_grid.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"
#include "tests/support/typed.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

template <class K> struct ChoosesLight : std::bool_constant<K::chooses_light> {
};
template <class K> struct ChoosesNoLight : std::bool_constant<!K::chooses_light> {
};

template <class K> class EveryLightTechnique : public testing::Test {
};
template <class K> class EveryDirectionTechnique : public testing::Test {
};
using LightTechniques = TestedTypes<Filtered<Techniques, ChoosesLight>>;
using DirectionTechniques = TestedTypes<Filtered<Techniques, ChoosesNoLight>>;
TYPED_TEST_SUITE(EveryLightTechnique, LightTechniques, RegisteredName);
TYPED_TEST_SUITE(EveryDirectionTechnique, DirectionTechniques, RegisteredName);

constexpr double false_alarm = 1e-6;  // of each χ² test here

const Vec3<double> n{0, 0, 1};
const Vec3<double> high{0.4, 0.2,
                        1};  ///< an axis; caps about it are above the horizon up to 1.15 rad

Cap<double> some_cap(double theta, const Vec3<double>& axis = high)
{
    return cap_of_sphere(normalized(axis) * 5.0, 5 * std::sin(theta), Vec3<double>(0));
}

/// An axis whose sine of elevation is `height` times the sine of the half-angle: the horizon cuts
/// caps about it where |height| < 1.
Vec3<double> axis_at_height(double theta, double height)
{
    const double c = height * std::sin(theta), flat = std::sqrt(1 - c * c);
    return {0.6 * flat, -0.8 * flat, c};
}

/// χ² of draws in the cap against the technique's density there, on equal cells of 1 − cos θ and
/// azimuth.
template <class K> void expect_draws_follow_density_in_cap(double theta, const Vec3<double>& axis)
{
    constexpr int side = 16, steps = 16;  // cells, and steps of the quadrature in each, either way
    const Cap<double> cap = some_cap(theta, axis);
    const Frame<double> frame = frame_around(cap.axis);
    const double whole = cap.one_minus_cos();
    const int draws = scaled(200'000);
    // What the nodes may miss of a cell of which the horizon leaves a sliver: a draw or two in all.
    constexpr double sliver = 0.02;
    std::vector<double> expected(side * side, sliver), observed(side * side);
    for (int a = 0; a < side * steps; ++a)
        for (int b = 0; b < side * steps; ++b) {
            const double v = (a + 0.5) / (side * steps) * whole,
                         phi = 2 * std::numbers::pi * (b + 0.5) / (side * steps);
            const double s = std::sqrt(v * (2 - v));
            const Vec3<double> w = frame.to_world({s * std::cos(phi), s * std::sin(phi), 1 - v});
            const double measure = cap.solid_angle() / (side * steps * side * steps);
            expected[static_cast<std::size_t>(a / steps * side + b / steps)] +=
                draws * measure * K::pdf(cap, n, dot(n, w));
        }
    Uniforms uniforms(41);
    for (int i = 0; i < draws; ++i) {
        const Vec3<double> offset = frame.to_local(K::draw(cap, n, uniforms.pair()).offset);
        const double turn = std::atan2(offset.y, offset.x) / (2 * std::numbers::pi);
        const int ring = std::min(static_cast<int>(length2(offset) / 2 / whole * side), side - 1);
        const int sector =
            std::min(static_cast<int>((turn < 0 ? turn + 1 : turn) * side), side - 1);
        ++observed[static_cast<std::size_t>(ring * side + sector)];
    }
    EXPECT_GT(chi2_p_value(observed, expected), false_alarm) << theta << ", z " << cap.axis.z;
}

/// The density that a draw carries is the one recomputed for its direction.
template <class K, class T> void expect_density_is_the_draws()
{
    Uniforms uniforms(42);
    for (int i = 0; i < 5000; ++i) {
        const double theta = uniforms.log_between(1e-8, 1.569);
        const Cap<T> cap = cap_towards(vec_cast<T>(some_cap(theta).axis * 5.0),
                                       static_cast<T>(5 * std::sin(theta)),
                                       static_cast<T>(25 * std::cos(theta) * std::cos(theta)));
        const Vec2<double> u = uniforms.pair();
        const CapDraw<T> draw =
            K::draw(cap, vec_cast<T>(n), Vec2<T>{static_cast<T>(u.x), static_cast<T>(u.y)});
        const T cos_theta = draw.cos_theta;
        const double inverse = static_cast<double>(cap.sin_max) *
                               static_cast<double>(cap.sin_max * draw.inverse_pdf_sin2);
        ASSERT_NEAR(inverse * static_cast<double>(K::pdf(cap, vec_cast<T>(n), cos_theta)), 1, 1e-5);
    }
}

/// A light draw hits its own sphere, at its distance, but for the rim.
template <class K> void expect_draws_hit_the_sphere()
{
    Uniforms uniforms(43);
    for (int i = 0; i < 20'000; ++i) {
        const Cap<double> cap = some_cap(uniforms.log_between(1e-6, 1.5));
        const Vec2<double> u = uniforms.pair();
        const CapDraw<double> draw = K::draw(cap, n, u);
        const double hit =
            hit_distance(cap.axis * cap.distance, cap.radius, cap.axis + draw.offset);
        if (u.x < 1 - 1e-9) {
            ASSERT_NEAR(hit / draw.distance, 1, 1e-6);
        }
        ASSERT_GE(draw.distance, cap.distance - cap.radius - 1e-9);
        ASSERT_LE(draw.distance * draw.distance, cap.gap2 * (1 + 1e-9));
    }
}

/// χ² of draws over the hemisphere against the technique's density, for every BSDF.
template <class K, class B> void expect_draws_follow_density_over_the_hemisphere()
{
    const B bsdf(materials_of(B::name)[0]);
    const Vec3<double> wo = normalized(Vec3<double>{0.3, 0.5, 1});
    const PolarGrid grid(n, 0.3, 8, 8);
    const int draws = scaled(100'000);
    std::vector<double> expected = grid.integrals(
        [&](const Vec3<double>& wi) { return K::pdf(bsdf.evaluate(wo, wi).pdf, wi); });
    double lost = 1;
    for (double& e : expected) lost -= e, e *= draws;
    expected.push_back(std::max(0.0, lost) * draws + 1e-3);
    std::vector<double> observed(expected.size());
    Uniforms uniforms(44);
    for (int i = 0; i < draws; ++i) {
        const double lobe = uniforms();
        const Vec3<double> wi = K::sample(bsdf, wo, lobe, uniforms.pair());
        ++observed[wi.z > 0 ? grid.cell(wi) : grid.size()];
    }
    EXPECT_GT(chi2_p_value(observed, expected), false_alarm) << B::name;
}

TYPED_TEST(EveryLightTechnique, DrawsFollowItsDensity)
{
    for (const double theta : {1e-3, 0.3, 1.0})
        expect_draws_follow_density_in_cap<TypeParam>(theta, high);
}

TYPED_TEST(EveryLightTechnique, DrawsFollowItsDensityInCapsThatTheHorizonCuts)
{
    for (const double theta : {1e-3, 0.3, 1.0, 1.5})
        for (const double height : {0.7, 0.05, -0.05, -0.7})
            expect_draws_follow_density_in_cap<TypeParam>(theta, axis_at_height(theta, height));
}

TYPED_TEST(EveryLightTechnique, ADrawHitsItsLightWithTheDensityThatItCarries)
{
    expect_density_is_the_draws<TypeParam, float>();
    expect_density_is_the_draws<TypeParam, double>();
    expect_draws_hit_the_sphere<TypeParam>();
}

TYPED_TEST(EveryDirectionTechnique, DrawsFollowItsDensity)
{
    for_each_type(Bsdfs{}, []<class B>() {
        expect_draws_follow_density_over_the_hemisphere<TypeParam, B>();
    });
}

}  // namespace
}  // namespace mis
