// The policies against their formulas, written down once more.
#include "mis/policy/all.h"
#include "mis/policy/irradiance.h"
#include "mis/policy/power.h"
#include "mis/policy/radiant_solid_angle.h"
#include "mis/policy/solid_angle.h"
#include "mis/policy/uniform.h"

#include "tests/policy/prepared.h"
#include "tests/support/irradiance.h"
#include "tests/support/lanes.h"
#include "tests/support/scenes.h"

#include <gtest/gtest.h>

#include <functional>

namespace mis {
namespace {

const Vec3<double> x{0.1, -0.2, 0.3}, up{0, 1, 0};

double brightness(const Light& l) { return luminance(radiance(l)); }

double solid_angle_from_x(const Light& l)
{
    const double s = l.radius / length(l.center - x);
    return 2 * std::numbers::pi * (1 - std::sqrt(1 - s * s));
}

/// P(j) = weight(j)/Σ weight.
template <class P>
void expect_in_proportion(const std::function<double(const Light&)>& weight,
                          const Lights& lights = thirty_lights_one_dark())
{
    double total = 0;
    for (const Light& l : lights) total += weight(l);
    const std::vector<double> found = Prepared<P>(lights, x, up).probabilities();
    for (std::size_t j = 0; j < lights.size(); ++j)
        EXPECT_NEAR(found[j], weight(lights[j]) / total, 3e-7 * found[j]) << j;
}

TEST(UniformPolicy, DrawsEveryLightAlike)
{
    expect_in_proportion<UniformPolicy>([](const Light&) { return 1; });
}
TEST(PowerPolicy, DrawsInProportionToLuminanceTimesArea)
{
    expect_in_proportion<PowerPolicy>(
        [](const Light& l) { return brightness(l) * l.radius * l.radius; });
}
TEST(SolidAnglePolicy, DrawsInProportionToTheSolidAngle)
{
    expect_in_proportion<SolidAnglePolicy>(solid_angle_from_x);
}
TEST(RadiantSolidAnglePolicy, DrawsInProportionToLuminanceTimesSolidAngle)
{
    expect_in_proportion<RadiantSolidAnglePolicy>(
        [](const Light& l) { return brightness(l) * solid_angle_from_x(l); });
}

TEST(IrradiancePolicy, DrawsInProportionToLuminanceTimesIrradianceAboveTheHorizon)
{
    Lights lights = thirty_lights_one_dark();
    for (const double s : {0.05, 0.3, 0.9})
        for (const double height : {0.9, 0.0, -0.5, -0.9})
            lights.push_back(low_light(x, s, (1 + height) * s));
    const auto weight = [](const Light& l) {
        const double d = length(l.center - x), s = l.radius / d, c = dot(up, l.center - x) / d;
        return brightness(l) * s * s * exact_irradiance_over_sin2(s, c);
    };
    expect_in_proportion<IrradiancePolicy>(weight, lights);
}

TEST(IrradiancePolicy, ALightBelowTheHorizonIsNotDrawn)
{
    for (const double s : {1e-20, 1e-8, 1e-4, 0.1, 0.5}) {
        const Lights near{low_light(x, s, -1e-4)}, nearer{low_light(x, s, -1e-10)};
        EXPECT_EQ((Prepared<IrradiancePolicy, float>(near, x, up).choose(5).light), no_light);
        EXPECT_EQ((Prepared<IrradiancePolicy, double>(nearer, x, up).choose(5).light), no_light);
    }
}

/// As rounding may put a point into a light, or onto its centre.
TEST(IrradiancePolicy, APointInALightHasProbabilitiesThatAreNumbers)
{
    for (const double off : {0.0, 1e-30, 0.3, 1.0}) {
        const Lights lights{make_light(x + Vec3<double>(0, off, 0), 1, Vec3<double>(1)),
                            make_light(x + Vec3<double>(1, 1, 0), 0.1, Vec3<double>(1))};
        const Prepared<IrradiancePolicy, TestLanes<float>> table(lights, x, up);
        EXPECT_NEAR(table.sum(), 1, 1e-12) << off;
        EXPECT_GE(table.probability(0), 0);
        EXPECT_GT(table.probability(1), 0);
    }
}

TEST(AllPolicy, ExpectsOneDrawOfEveryLight)
{
    const Lights lights = thirty_lights_one_dark();
    const Prepared<AllPolicy> table(lights, x, up);
    for (std::size_t j = 0; j < lights.size(); ++j) EXPECT_EQ(table.probability(j), 1);
}

TEST(BlackLights, AreNotDrawnByPoliciesThatSeeRadiance)
{
    Lights lights = thirty_lights_one_dark();
    EXPECT_EQ((Prepared<PowerPolicy>(lights, x, up).probability(6)), 0);
    EXPECT_EQ((Prepared<RadiantSolidAnglePolicy>(lights, x, up).probability(6)), 0);
    EXPECT_EQ((Prepared<IrradiancePolicy>(lights, x, up).probability(6)), 0);
    for (Light& l : lights) l.radiance_radius = Vec3<float>(0);
    EXPECT_EQ((Prepared<PowerPolicy>(lights, x, up).choose(5).light), no_light);
    EXPECT_EQ((Prepared<RadiantSolidAnglePolicy>(lights, x, up).choose(5).light), no_light);
    EXPECT_EQ((Prepared<IrradiancePolicy>(lights, x, up).choose(5).light), no_light);
}

}  // namespace
}  // namespace mis
