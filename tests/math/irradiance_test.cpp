#include "mis/math/irradiance.h"

#include "tests/support/irradiance.h"
#include "tests/support/lanes.h"

#include <gtest/gtest.h>
#include <boost/math/quadrature/tanh_sinh.hpp>

#include <numbers>
#include <vector>

namespace mis {
namespace {

constexpr double pi_ = std::numbers::pi;

template <class T> class IrradianceOf : public testing::Test {
public:
    static constexpr double tolerance = std::is_same_v<Scalar<T>, float> ? 1e-5 : 1e-11;
};
using NumberTypes = testing::Types<float, double, TestLanes<float>, TestLanes<double>>;
TYPED_TEST_SUITE(IrradianceOf, NumberTypes);

/// Of a cap's rim over the horizon, as a share of its half-angle: 1 just above, −1 just below.
std::vector<double> heights()
{
    std::vector<double> all{2, 1, 0, 1e-6, 1e-3};
    for (double from_end = 0.9; from_end > 1e-6; from_end /= 1.7)
        all.push_back(1 - from_end), all.push_back(from_end - 1);
    all.push_back(1 - 1e-6), all.push_back(1e-6 - 1);
    return all;
}

/// Every height of caps from 1e-8 rad to one that leaves 1e-4 rad of half the sky.
template <class S> std::vector<KnownIrradiance<S>> every_cap()
{
    std::vector<KnownIrradiance<S>> all;
    for (const double s : {1e-8, 1e-7, 1e-5, 1e-4, 1e-3, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6})
        for (const double height : heights()) all.push_back(known_by_sines<S>(s, height * s));
    for (const double k : {0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.01, 1e-3, 4.47e-4, 1e-4})
        for (const double rise : {1e-6, 1e-5, 1e-3, 0.1, 0.5, 1.0, 2.0, 5.0, 20.0, 100.0})
            for (const bool is_sunken : {false, true})
                if (k * (1 + rise) <= 1)
                    all.push_back(known_by_cosines<S>(k, k * (1 + rise), is_sunken));
    return all;
}

/// in_lane(i): the cap of lane i.
template <class T, class F> T irradiance_of_lanes(const F& in_lane)
{
    using C = TiltedCap<Scalar<T>>;
    const auto lanes = [&](Scalar<T> C::*field) {
        return lanes_from<T>([&](std::size_t i) { return in_lane(i).cap.*field; });
    };
    return irradiance_over_sin2(TiltedCap<T>{lanes(&C::sin_max), lanes(&C::cos_max),
                                             lanes(&C::cos_beta), lanes(&C::sin_beta)});
}

/// Caps of all kinds stand side by side in the lanes.
TYPED_TEST(IrradianceOf, ACapIsRightUpToTangencyAndPositive)
{
    using T = TypeParam;
    const auto known = every_cap<Scalar<T>>();
    ASSERT_GT(known.size(), 400U);
    for (std::size_t k = 0; k < known.size(); ++k) {
        const auto in_lane = [&](std::size_t i) { return known[(k + 37 * i) % known.size()]; };
        const T found = irradiance_of_lanes<T>(in_lane);
        for (std::size_t i = 0; i < lane_count<T>; ++i) {
            const auto& [cap, exact] = in_lane(i);
            EXPECT_NEAR(static_cast<double>(lane(found, i)), exact, this->tolerance * exact)
                << "sin_max = " << cap.sin_max << ", cos_max = " << cap.cos_max
                << ", cos_beta = " << cap.cos_beta << ", sin_beta = " << cap.sin_beta;
            EXPECT_EQ(lane(found, i) > 0, exact > 0);
        }
    }
}

/// The twin: the textbook's form in float is 11 times too big, negative elsewhere.
TEST(Textbook, FormInFloatIsSeenToBeWrong)
{
    const auto textbook = [](float s, float c) {
        const float x = std::sqrt(1 / (s * s) - 1), sine = std::sqrt(1 - c * c);
        const float y = std::clamp(-x * c / sine, -1.F, 1.F), z = sine * std::sqrt(1 - y * y);
        return double(s * s * (c * std::acos(y) - x * z) + std::atan(z / x)) / double(s * s);
    };
    EXPECT_GT(textbook(1e-4F, 0), 5 * exact_irradiance_over_sin2(1e-4, 0));
    bool is_negative = false;
    for (float height = 0.9F; height < 1; height += 0.003F)
        is_negative |= textbook(0.01F, -0.01F * height) < 0;
    EXPECT_TRUE(is_negative);
}

TYPED_TEST(IrradianceOf, ACapAboveTheHorizonIsPiTimesTheCosineAndOfOneBelow0)
{
    using T = TypeParam;
    for (const double s : {1e-20, 1e-8, 0.1, 0.6, 0.99, 0.999999})
        for (const double c : {s, 0.5 * (1 + s), 1.0}) {
            const auto cap = known_by_sines<Scalar<T>>(s, c).cap;
            const auto at = [&](Scalar<T> cosine) {
                return lane(irradiance_over_sin2(TiltedCap<T>{T(cap.sin_max), T(cap.cos_max),
                                                              T(cosine), T(cap.sin_beta)}),
                            0);
            };
            EXPECT_EQ(at(cap.cos_beta), pi<Scalar<T>> * cap.cos_beta);
            EXPECT_EQ(at(-cap.cos_beta), 0);
        }
}

/// A point on a light: half the sky, cut by the horizon, is π/2 (1 + cos β).
TYPED_TEST(IrradianceOf, HalfTheSkyIsThatOfALune)
{
    using T = TypeParam;
    for (double beta = 0.01; beta < 3.14; beta += 0.1) {
        const auto c = static_cast<Scalar<T>>(std::cos(beta)),
                   sine = static_cast<Scalar<T>>(std::sin(beta));
        const auto found = static_cast<double>(lane(
            irradiance_over_sin2(TiltedCap<T>{T(Scalar<T>(1)), T(Scalar<T>(0)), T(c), T(sine)}),
            0));
        const double exact = pi_ * std::pow(std::cos(beta / 2), 2);
        EXPECT_NEAR(found / exact, 1, 100 * ulp_of<T> / std::pow(std::cos(beta / 2), 2));
    }
}

/// Of vectors, what their own rounding leaves: an angle that is off by ε costs 5/2 ε over the
/// height of the rim.
TYPED_TEST(IrradianceOf, VectorsIsAsGoodAsTheirAngles)
{
    using T = TypeParam;
    using S = Scalar<T>;
    const Vec3<double> n = normalized(Vec3<double>{1, 2, -2});
    const Vec3<S> normal = vec_cast<S>(n);
    const Frame<double> frame = frame_around(n);
    for (const double s : {1e-3, 0.1, 0.5, 0.9, 0.99})
        for (const double height : {0.9, 0.3, -0.3, -0.9, -0.99}) {
            const double c = height * s, d = 3;
            const Vec3<double> axis = frame.to_world({std::sqrt(1 - c * c), 0, c});
            const Cap<T> cap =
                cap_towards(Vec3<T>{T(S(d * axis.x)), T(S(d * axis.y)), T(S(d * axis.z))},
                            T(S(d * s)), T(S(d * d * (1 - s) * (1 + s))));
            const auto found = static_cast<double>(lane(
                irradiance_over_sin2(tilted(cap, Vec3<T>{T(normal.x), T(normal.y), T(normal.z)})),
                0));
            const double off = 4 * ulp_of<T> / (s * (1 + height) * std::sqrt(1 - s * s));
            EXPECT_NEAR(found / exact_irradiance_over_sin2(s, c), 1, this->tolerance + 2.5 * off)
                << s << " " << height;
        }
}

/// ∫ cos θ over the cap above the horizon, ring by ring: what the closed form is the integral of.
TEST(ExactIrradiance, IsTheIntegralOverTheCap)
{
    boost::math::quadrature::tanh_sinh<double> rule;
    for (const double theta_max : {0.05, 0.5, 1.2, 1.5})
        for (const double beta : {0.1, 0.4, 1.0, 1.5, 1.6, 2.0}) {
            const auto ring = [&](double theta) {
                const double cos_phi = (std::cos(theta_max) - std::cos(theta) * std::cos(beta)) /
                                       (std::sin(theta) * std::sin(beta));
                return 2 * std::acos(std::clamp(cos_phi, -1.0, 1.0)) * std::cos(theta) *
                       std::sin(theta);
            };
            const double inner = std::abs(beta - theta_max);
            const double low = std::min(inner, pi_ / 2), high = std::min(beta + theta_max, pi_ / 2);
            double exact = low < high ? rule.integrate(ring, low, high) : 0;
            if (beta < theta_max) exact += pi_ * std::pow(std::sin(low), 2);
            const double s = std::sin(theta_max);
            EXPECT_NEAR(s * s * exact_irradiance_over_sin2(s, std::cos(beta)), exact, 1e-7)
                << theta_max << " " << beta;
        }
}

}  // namespace
}  // namespace mis
