#include "mis/math/stable.h"

#include "tests/support/lanes.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

template <class T> class EveryNumber : public testing::Test {
};
using NumberTypes = testing::Types<float, double, TestLanes<float>, TestLanes<double>>;
TYPED_TEST_SUITE(EveryNumber, NumberTypes);

/// The angles at which cos^m is neither 1 nor below the least number, for m from 1 to 1e6.
template <class Body> void for_each_power(const Body& body)
{
    for (const double m : {1.0, 2.0, 33.0, 1e3, 1e4, 1e5, 1e6})
        for (const double log_value : {-1e-6, -1e-3, -0.1, -1.0, -5.0, -20.0, -60.0}) {
            const double sin2 = -std::expm1(2 * log_value / m);
            if (sin2 > 0 && sin2 < 1) body(m, sin2);
        }
}

TYPED_TEST(EveryNumber, CosToTheMIsRightTo4UlpTimesOnePlusItsLogarithm)
{
    using T = TypeParam;
    for_each_power([](double m, double exact_sin2) {
        // What the formula is given, in its own number type.
        const auto sin2 = static_cast<Scalar<T>>(exact_sin2),
                   cos2 = static_cast<Scalar<T>>(1 - exact_sin2);
        const bool near_axis = sin2 < Scalar<T>(0.5);
        const long double ln = near_axis ? std::log1p(-static_cast<long double>(sin2))
                                         : std::log(static_cast<long double>(cos2));
        const long double log_value = static_cast<long double>(m) / 2 * ln;
        const auto exact = static_cast<double>(std::exp(log_value));
        const auto found = static_cast<double>(lane(pow_cos(T(sin2), T(cos2), m), 0));
        const double allowed = 4 * ulp_of<T> * (1 + std::abs(static_cast<double>(log_value)));
        EXPECT_NEAR(found / exact, 1, allowed) << "m = " << m << ", sin2 = " << exact_sin2;
    });
}

TYPED_TEST(EveryNumber, CosToThe0Is1EvenAtTheHorizon)
{
    using T = TypeParam;
    for (const double sin2 : {0.0, 0.3, 0.9, 1.0})
        EXPECT_EQ(lane(pow_cos(number<T>(sin2), number<T>(1 - sin2), 0), 0), 1) << sin2;
}

TYPED_TEST(EveryNumber, CosToTheMIs0AtTheHorizonAndNeverANumberThatIsNone)
{
    using T = TypeParam;
    EXPECT_LE(lane(pow_cos(number<T>(1), number<T>(0), 2), 0), 1e-30);
    EXPECT_EQ(lane(pow_cos(number<T>(1), number<T>(0), 1e6), 0), 0);
    EXPECT_EQ(lane(pow_cos(number<T>(0), number<T>(1), 1e6), 0), 1);
}

/// 1 − cos θ = 1 − (1 − u)^(1/(m+1)): to a few ulp, where the power itself would be 1 to rounding.
TYPED_TEST(EveryNumber, TheLobesOneMinusCosKeepsItsDigitsForAnyExponent)
{
    using T = TypeParam;
    for (const double m : {0.0, 1.0, 100.0, 1e6, 1e9})
        for (const double u : {1e-7, 1e-3, 0.25, 0.5, 0.9, 0.999}) {
            const auto given = static_cast<Scalar<T>>(u);
            const long double exact = -std::expm1(std::log1p(-static_cast<long double>(given)) /
                                                  (static_cast<long double>(m) + 1));
            const auto found = static_cast<double>(lane(one_minus_cos_of_lobe(T(given), m), 0));
            EXPECT_NEAR(found / static_cast<double>(exact), 1, 6 * ulp_of<T>)
                << "m = " << m << ", u = " << u;
        }
}

TYPED_TEST(EveryNumber, TheLobesOneMinusCosIs0AtTheAxisAndAtMost1)
{
    using T = TypeParam;
    const Scalar<T> last = std::nextafter(Scalar<T>(1), Scalar<T>(0));
    for (const double m : {0.0, 10.0, 1e6}) {
        EXPECT_EQ(lane(one_minus_cos_of_lobe(number<T>(0), m), 0), 0);
        EXPECT_LE(lane(one_minus_cos_of_lobe(T(last), m), 0), 1);
    }
}

}  // namespace
}  // namespace mis
