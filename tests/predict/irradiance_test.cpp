// What the choice by irradiance is worth where nothing shades, of a Lambertian point.
#include "mis/predict/predict.h"

#include "tests/predict/predict_cases.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// 32 lights in a box over the floor, their radius and radiance log-uniform, none of them cut by
/// the horizon. scale: of the radii.
Scene lamps_over_a_floor(double scale)
{
    Scene scene = empty_scene(lambert(0.5));
    Uniforms u(32);
    for (int j = 0; j < 32; ++j) {
        const Vec3<double> center{u.between(-5, 5), u.between(-5, 5), u.between(0.7, 4)};
        const double radius = u.log_between(0.03, 0.6), radiance = u.log_between(1, 100);
        scene.lights.push_back(make_light(center, scale * radius, Vec3<double>(radiance)));
    }
    return scene;
}

double relative_variance(const Scene& scene, std::string_view strategy)
{
    const Predicted p = predict_one(scene, strategy);
    return p.variance / (p.mean * p.mean);
}

TEST(PredictIrradiance, IsFarBelowTheClassicsUnderManyLamps)
{
    double sum[4] = {};
    Scene scene = lamps_over_a_floor(1);
    for (const double x : {-4.0, -1.5, 1.5, 4.0})
        for (const double y : {-4.0, -1.5, 1.5, 4.0}) {
            scene.probes[0].position = {x, y, 0};
            int k = 0;
            for (const char* policy : {"irradiance", "radiant-solid-angle", "power", "uniform"})
                sum[k++] += relative_variance(scene, std::string(policy) + "/light");
        }
    EXPECT_LT(sum[0], 0.4 * sum[1]);
    EXPECT_LT(sum[0], 0.1 * sum[2]);
    EXPECT_LT(sum[0], 0.05 * sum[3]);
}

/// Lights too small for the cosine to vary within them: the choice alone makes the variance, and
/// this one makes none.
TEST(PredictIrradiance, LeavesNoVarianceOfSmallLights)
{
    const Scene scene = lamps_over_a_floor(1e-4);
    EXPECT_LT(relative_variance(scene, "irradiance/light"), 1e-8);
    EXPECT_GT(relative_variance(scene, "radiant-solid-angle/light"), 0.01);
}

/// Drawn in proportion to the cosine as well, lights of any size leave none; nor do those that the
/// horizon cuts. Twins: drawn over the whole cap they do, and so they do where one hides another.
TEST(PredictIrradiance, LeavesNoVarianceOfProjectedCaps)
{
    const std::vector<Strategy> exact = strategies_of(
        {"irradiance/light/projected", "all/light/projected", "irradiance/light/projected@3+0"});
    Scene scene = lamps_over_a_floor(0.05);
    const auto check = [&] {
        for (const Predicted& p : predict(scene, scene.probes[0], exact)) {
            EXPECT_LT(p.variance, 1e-24 * p.mean * p.mean);
            EXPECT_LT(p.variance_error, 1e-15 * p.mean * p.mean);
        }
        EXPECT_GT(relative_variance(scene, "irradiance/light"), 1e-7);
    };
    check();
    scene.lights.resize(3);
    scene.lights.push_back(make_light({0, 3, 0.1}, 0.5, Vec3<double>(5)));
    scene.lights.push_back(make_light({0, -3, -0.2}, 0.5, Vec3<double>(5)));
    scene.lights.push_back(make_light({0, -3, -2}, 0.5, Vec3<double>(5)));  // wholly below
    check();
    // Drawn as often as the others, a light below the horizon is worth 0 each time.
    EXPECT_GT(relative_variance(scene, "uniform/light/projected"), 0.1);
    scene.lights.push_back(make_light({0, 2.4, 0.2}, 0.1, Vec3<double>(5)));
    EXPECT_GT(relative_variance(scene, "irradiance/light/projected"), 1e-3);
}

}  // namespace
}  // namespace mis
