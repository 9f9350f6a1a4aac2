#include "mis/math/gauss_legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

TEST(GaussLegendre, IsExactForPolynomialsOfDegree15AndNotOf16)
{
    for (int degree = 0; degree <= 15; ++degree) {
        const auto power = [degree](double x) { return std::pow(x, degree); };
        EXPECT_NEAR(integrate(power, -1, 2, 1) * (degree + 1),
                    std::pow(2, degree + 1) - std::pow(-1, degree + 1),
                    1e-13 * std::pow(2, degree + 1))
            << degree;
    }
    const double of_16 = integrate([](double x) { return std::pow(x, 16); }, 0, 1, 1);
    EXPECT_GT(std::fabs(of_16 * 17 - 1), 1e-10);
}

TEST(GaussLegendre, PanelsAddUp)
{
    const auto f = [](double x) { return std::exp(-x) * x * x; };
    EXPECT_NEAR(integrate(f, 0, 60, 32), 2, 1e-13);
    EXPECT_NEAR(integrate(f, 0, 7, 5) + integrate(f, 7, 60, 40), 2, 1e-13);
    EXPECT_EQ(integrate(f, 3, 3, 4), 0);
}

}  // namespace
}  // namespace mis
