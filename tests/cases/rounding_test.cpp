#include "tests/cases/cases.h"
#include "tests/cases/measure.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mis {
namespace {

/// Near the edge of a light that fills half the sky, sin θ hardly changes: a direction whose length
/// is off by a float's rounding would miss it from 2e-4 rad inside the edge, and the mean would be
/// 2e-5 too low. A direction that goes the other way by rounding is one of 1e6.
TEST(Rounding, OfADirectionsLengthDoesNotMoveTheEdgeOfALightThatFillsHalfTheSky)
{
    const std::vector<Case> cases = hard_cases();
    const Case& c = *std::find_if(cases.begin(), cases.end(),
                                  [](const Case& k) { return k.name == "cap_89.999_degrees"; });
    const ReadyCase ready(c.scene);
    constexpr int samples = 1'000'000;
    const Strategy s = parse_strategy("brdf");
    const double usual =
        run_case<double>(ready, s, kernels<double>(), samples, 3).result.luminance.mean;
    const double found =
        run_case<float>(ready, s, kernels<float>(), samples, 3).result.luminance.mean;
    EXPECT_NEAR(found / usual, 1, 5e-6);
}

}  // namespace
}  // namespace mis
