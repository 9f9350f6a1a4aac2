// Shared samples as studies use them: on any number of threads, stopped, and against the scalar
// twin.
#include "mis/study/shared_samples.h"

#include "mis/run/serial.h"
#include "mis/run/tbb.h"
#include "mis/strategy/names.h"
#include "mis/study/study.h"
#include "mis/study/study_points.h"
#include "mis/trace/analytic.h"

#include "tests/study/scalar_audit.h"
#include "tests/study/small_picture.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

/// A scene, and some points of its picture.
struct SharedGround {
    Scene scene;
    AnalyticTracer tracer;
    LitScene lit;
    std::vector<SharedPoint> points;

    explicit SharedGround(const Scene& s, std::size_t most = 200)
        : scene(s), tracer(scene), lit(scene, &tracer, called_for(scene))
    {
        const StudyPoints found = find_study_points(lit, any_executor(SerialExecutor{}));
        for (const std::size_t p : spread_points(found, most))
            points.push_back({found.shading.points[p], found.material_of(p)});
    }
};

TEST(SharedSamples, AreTheSameOnAnyNumberOfThreadsAndInAnyParts)
{
    const SharedGround ground(small_picture());
    const auto strategies =
        strategies_named({"product/balance", "all/light", "all/power/union", "brdf",
                          "uniform/light/projected", "power/balance/one-sample"});
    SharedSamples one(ground.lit, ground.points, strategies, {}),
        three(ground.lit, ground.points, strategies, {});
    one.take(6, any_executor(SerialExecutor{}));
    three.take(2, any_executor(TbbExecutor(3)));
    three.take(4, any_executor(TbbExecutor(3)));
    EXPECT_EQ(one.rounds(), 5);
    for (std::size_t s = 0; s < strategies.size(); ++s)
        for (std::size_t p = 0; p < ground.points.size(); ++p) {
            ASSERT_EQ(one.at(s, p).value, three.at(s, p).value) << name_of(strategies[s]);
            ASSERT_EQ(one.at(s, p).se, three.at(s, p).se);
            ASSERT_EQ(one.luminance(p).value, three.luminance(p).value);
        }
}

TEST(SharedSamples, StopBetweenPointsAndSayThatTheyAreUneven)
{
    const SharedGround ground(small_picture());
    const std::atomic<bool> stop{true};
    SharedSamples shared(ground.lit, ground.points, strategies_named({"power/light"}),
                         {.stop = StopToken(&stop)});
    shared.take(3, any_executor(SerialExecutor{}));
    EXPECT_FALSE(shared.is_even());
}

TEST(SharedSamples, StopBetweenRounds)
{
    const SharedGround ground(probe_under(three_lights_apart(), grey_floor()));
    int asks = 0;
    const std::function<bool()> asked = [&] { return ++asks > 20; };
    SharedSamples shared(ground.lit, ground.points, strategies_named({"power/light"}),
                         {.stop = StopToken(&asked)});
    shared.take(1000, any_executor(SerialExecutor{}));
    EXPECT_FALSE(shared.is_even());
    EXPECT_LE(asks, 22);
}

/// Every draw is worth the same: the variance is 0, not nearly so. And in the dark it is 0 itself.
TEST(SharedSamples, KeepAnExactZero)
{
    Scene lamps = probe_under(three_lights_apart(), grey_floor());
    const auto strategies = strategies_named({"irradiance/light/projected", "all/light/projected",
                                              "product/light/projected", "uniform/light"});
    for (const bool is_dark : {false, true}) {
        if (is_dark)
            for (Light& light : lamps.lights) light.radiance_radius = Vec3<float>(0.0F);
        const SharedGround ground(lamps);
        SharedSamples shared(ground.lit, ground.points, strategies, {});
        shared.take(20, any_executor(SerialExecutor{}));
        const double mean = shared.luminance(0).value;
        for (std::size_t s = 0; s < 3; ++s)
            EXPECT_LE(std::abs(shared.at(s, 0).value), 1e-12 * mean * mean)
                << name_of(strategies[s]);
        if (is_dark) {
            EXPECT_EQ(mean, 0);
            EXPECT_EQ(shared.at(3, 0).value, 0);
        } else {
            EXPECT_GT(shared.at(3, 0).value, 1e-3 * mean * mean);
        }
    }
}

/// A lobe of all draws, too sharp for a double to hold its density elsewhere.
TEST(SharedSamples, SayWhatAStrategyNeverDraws)
{
    Material material;
    material.type = "blinn", material.exponent = 1e6;
    material.diffuse = Vec3<double>(0.5), material.specular = Vec3<double>(0.5);
    material.specular_probability = 1;
    const SharedGround ground(probe_under(three_lights_apart(), material));
    SharedSamples shared(ground.lit, ground.points, strategies_named({"brdf", "power/balance"}),
                         {});
    shared.take(20, any_executor(SerialExecutor{}));
    EXPECT_GT(shared.missed(0), 0.1 * shared.luminance(0).value);
    EXPECT_EQ(shared.missed(1), 0);
}

/// Past the number that each have a probability of their own in the mixture.
TEST(SharedSamples, OfManyLightsAgreeWithOwnSamples)
{
    constexpr double false_alarm = 1e-6;  // for all strategies together
    Uniforms u(4);
    Scene scene = probe_under({}, grey_floor());
    for (int i = 0; i < 10'500; ++i)
        scene.lights.push_back(make_light({u.between(-9, 9), u.between(2, 6), u.between(-9, 9)},
                                          u.between(0.01, 0.04), Vec3<double>(u.between(1, 3))));
    const auto strategies =
        strategies_named({"uniform/light", "power/balance", "solid-angle/light", "tree/light",
                          "power/light/union", "tree/power/one-sample"});
    const SharedGround ground(scene);
    const AnyExecutor serial = any_executor(SerialExecutor{});
    const Study own = run_study(ground.lit, strategies,
                                {.spp = static_cast<std::uint64_t>(scaled(20'000))}, serial);
    SharedSamples shared(ground.lit, ground.points, strategies, {.seed = 5});
    shared.take(scaled(1'000) + 1, serial);
    const double bound = 1.2 * z_bound(false_alarm, static_cast<int>(strategies.size()));
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        const Moments& moments = own.runs[s]->results()[0].luminance;
        const ValueAndError found = shared.at(s, 0);
        EXPECT_NEAR(found.value, moments.variance(),
                    bound * std::hypot(found.se, moments.variance_se()))
            << name_of(strategies[s]);
        EXPECT_LT(found.se, 0.2 * found.value) << name_of(strategies[s]);
    }
}

/// Two estimates of the same variances, by code that shares the formulas of choices alone.
TEST(SharedSamples, AgreeWithTheScalarTwin)
{
    constexpr double false_alarm = 1e-6;  // for all strategies together
    const SharedGround ground(small_picture());
    const auto strategies =
        strategies_named({"uniform/light", "power/light", "solid-angle/balance", "power/power",
                          "brdf", "cosine", "uniform/power/union", "power/balance/one-sample",
                          "uniform/balance@3+2", "solid-angle/cutoff", "uniform/maximum"});
    const AnyExecutor serial = any_executor(SerialExecutor{});
    SharedSamples shared(ground.lit, ground.points, strategies, {.seed = 5});
    shared.take(scaled(40) + 1, serial);
    std::vector<AuditPoint> at;
    for (const SharedPoint& p : ground.points) at.push_back({p.point, p.material});
    const std::vector<AuditEstimate> twin = scalar_audit(ground.lit, at, strategies, 5, serial);
    const double bound =
        1.5 * z_bound(false_alarm, static_cast<int>(strategies.size()));  // errors from 8 groups
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        const ValueAndError found = shared.mean(s);
        EXPECT_NEAR(found.value, twin[s].variance,
                    bound * std::hypot(found.se, twin[s].variance_se))
            << name_of(strategies[s]);
        EXPECT_LT(twin[s].variance_se, 0.3 * found.value);  // so that the test can fail
        EXPECT_LT(found.se, 0.05 * found.value) << name_of(strategies[s]);
    }
}

}  // namespace
}  // namespace mis
