// The least that scenes may hold, in float: the same figures as in double, and where a host has set
// its processor to take denormal numbers for 0.
#include "mis/engine/direct_lights.h"
#include "mis/engine/radiance_scale.h"
#include "mis/policy/radiant_solid_angle.h"
#include "mis/scene/validate.h"

#include "tests/engine/bench.h"

#include <gtest/gtest.h>

#if defined(__SSE2__)
#include <pmmintrin.h>
#include <xmmintrin.h>
#endif

namespace mis {
namespace {

/// While it lives, this thread flushes denormal results to 0 and takes denormal operands for 0.
class DenormalsAreZero {
public:
#if defined(__SSE2__)
    DenormalsAreZero() : before_(_mm_getcsr())
    {
        _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
        _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    }
    ~DenormalsAreZero() { _mm_setcsr(before_); }
    static constexpr bool is_there = true;

private:
    unsigned before_;
#elif defined(__aarch64__)
    DenormalsAreZero()
    {
        asm volatile("mrs %0, fpcr" : "=r"(before_));
        asm volatile("msr fpcr, %0" : : "r"(before_ | 1UL << 24));
    }
    ~DenormalsAreZero() { asm volatile("msr fpcr, %0" : : "r"(before_)); }
    static constexpr bool is_there = true;

private:
    unsigned long before_ = 0;
#else
    static constexpr bool is_there = false;
#endif
};

struct Extreme {
    double unit;             ///< of length
    double sine;             ///< radius over distance
    double radiance_radius;  ///< of the dimmer light
};

std::ostream& operator<<(std::ostream& out, const Extreme& e)
{
    return out << "unit " << e.unit << ", radius/distance " << e.sine << ", radiance·radius "
               << e.radiance_radius;
}

/// Two lights over a probe; the second is three times as large, ten times as bright, and blue.
Scene scene_of(const Extreme& e, const Material& material)
{
    const double r = e.sine * e.unit;
    const Light first = make_light({0, e.unit, 0}, r, Vec3<double>(e.radiance_radius / r)),
                second = make_light({e.unit, e.unit, 0}, 3 * r,
                                    Vec3<double>{1, 0, 10} * (e.radiance_radius / r));
    return probe_under({first, second}, material);
}

/// All that the rules accept.
std::vector<Extreme> extremes()
{
    std::vector<Extreme> all;
    for (const double unit : {1e-17, 1e-12, 1.0, 1e6, 9e14})
        for (const double sine : {0.1, 1e-10, 1e-20, 1e-29})
            for (const double radiance_radius :
                 {limits::min_radiance_radius, 10 * limits::min_radiance_radius, 1e-20, 1.0, 1e20,
                  limits::max_radiance_radius / 100}) {
                const Extreme e{unit, sine, radiance_radius};
                if (!find_problem(scene_of(e, grey_floor()))) all.push_back(e);
            }
    return all;
}

const std::array<Material, 2> materials{
    grey_floor(),
    {.type = "ggx", .diffuse = Vec3<double>(0.1), .specular = {0.9, 0.7, 0.3}, .alpha = 0.05}};

/// Strategies of which every sample meets its light: to rounding, float and double draw the same.
std::vector<Strategy> light_strategies()
{
    std::vector<Strategy> list;
    for (const Choosable& policy : policy_names())
        list.push_back(parse_strategy(policy.name + "/light"));
    for (const char* name : {"irradiance/light/projected", "all/light/union"})
        list.push_back(parse_strategy(name));
    return list;
}

/// And others, whose BSDF draws may meet one light in float, at its rim, and none in double.
std::vector<Strategy> strategies()
{
    std::vector<Strategy> list = light_strategies();
    for (const char* name :
         {"power/balance", "product/power/union", "uniform/balance/one-sample", "brdf"})
        list.push_back(parse_strategy(name));
    return list;
}

double mean_in_float(const TestScene& test, const Strategy& s)
{
    const Outcome outcome = run_probe<float>(test, s, kernels<float>(), 64);
    EXPECT_EQ(outcome.totals.invalid, 0U);
    return outcome.result.luminance.mean;
}

TEST(Floors, AreTheSameInFloatAsInDouble)
{
    for (const Extreme& e : extremes())
        for (const Material& material : materials) {
            const TestScene test(scene_of(e, material));
            for (const Strategy& s : light_strategies()) {
                const double exact =
                    run_probe<double>(test, s, kernels<double>(), 64).result.luminance.mean;
                ASSERT_GT(exact, 0) << name_of(s) << ", " << e;
                EXPECT_NEAR(mean_in_float(test, s) / exact, 1, 2e-4)
                    << name_of(s) << ", " << material.type << ", " << e;
            }
        }
}

TEST(Floors, AreTheSameWhereDenormalsAreZero)
{
    if (!DenormalsAreZero::is_there) GTEST_SKIP() << "no such mode is known of this processor";
    for (const Extreme& e : extremes())
        for (const Material& material : materials) {
            const TestScene test(scene_of(e, material));
            for (const Strategy& s : strategies()) {
                const double usual = mean_in_float(test, s);
                const DenormalsAreZero mode;
                EXPECT_NEAR(mean_in_float(test, s), usual, 1e-6 * usual)
                    << name_of(s) << ", " << material.type << ", " << e;
            }
        }
}

/// The twin: without the lift, what arrives from the dimmest lights is a denormal number.
TEST(Floors, NeedTheLift)
{
    const Extreme dimmest{1, 0.1, limits::min_radiance_radius};
    const TestScene test(scene_of(dimmest, grey_floor()));
    EXPECT_GT(test.lit.radiance_scale(), 1e30);
    const double mean = mean_in_float(test, parse_strategy("uniform/light"));
    EXPECT_LT(0.1 * mean, std::numeric_limits<float>::min());  // that of a tenth of the albedo
    EXPECT_GT(mean, 0);
}

TEST(RadianceScale, IsAPowerOfTwoAndOneWhereLightsAreOrdinary)
{
    for (const double ordinary : {1e-9, 1e-3, 1.0, 1e5, 1e18})
        EXPECT_EQ(radiance_scale(ordinary), 1) << ordinary;
    for (const double dim : {1e-10, 1e-20, 1e-37, 1e-52}) {
        int exponent = 0;
        EXPECT_EQ(std::frexp(radiance_scale(dim), &exponent), 0.5) << dim;
        EXPECT_GE(radiance_scale(dim) * dim, 1) << dim;
        EXPECT_LT(radiance_scale(dim) * dim, 2) << dim;
    }
    EXPECT_LT(radiance_scale(1e37) * 1e37, 1e19);
    EXPECT_EQ(radiance_scale(0), 1);
}

/// The scalar call of a host: light choice at the floor, and the result where a float holds it.
TEST(Floors, LeaveAHostsLightsTheirProbabilities)
{
    const Extreme dimmest{1, 0.1, limits::min_radiance_radius};
    const Lights lights = scene_of(dimmest, grey_floor()).lights;
    const auto probabilities = [&](const DirectLights<RadiantSolidAnglePolicy>& ready) {
        DirectPoint point(ready);
        point.move_to(Vec3<double>(0), {0, 1, 0});
        return std::array{point.probability(0), point.probability(1)};
    };
    const DirectLights<RadiantSolidAnglePolicy> dim(lights);
    const auto usual = probabilities(dim);
    EXPECT_GT(usual[0], 0.01);
    EXPECT_NEAR(usual[0] + usual[1], 1, 1e-6);
    const DenormalsAreZero mode;
    EXPECT_EQ(probabilities(dim), usual);
    Lights bright = lights;
    for (Light& light : bright) light.radiance_radius *= 1e30F;
    DirectLights<RadiantSolidAnglePolicy> changed(bright);
    for (LightIndex j = 0; j < 2; ++j) changed.replace(j, lights[static_cast<std::size_t>(j)]);
    EXPECT_EQ(probabilities(changed), usual);
}

}  // namespace
}  // namespace mis
