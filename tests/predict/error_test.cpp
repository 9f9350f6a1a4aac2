// Do the stated errors hold? A prediction to a hundredth of the tolerance must lie within them.
#include "tests/predict/predict_cases.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

void expect_within(double value, double error, double better, double better_error,
                   const std::string& what)
{
    EXPECT_LE(std::abs(value - better), error + better_error) << what << " " << value;
}

bool has_jumps(const Strategy& s) { return s.heuristic == "cutoff" || s.heuristic == "maximum"; }

void expect_bounds_the_change_of_a_tighter_tolerance(const Scene& scene,
                                                     const std::vector<Strategy>& all)
{
    const std::vector<Predicted> p = predict(scene, scene.probes[0], all);
    const std::vector<Predicted> q =
        predict(scene, scene.probes[0], all, {.smooth = 1e-9, .jumps = 1e-8});
    for (std::size_t i = 0; i < all.size(); ++i) {
        const std::string name = name_of(all[i]);
        expect_within(p[i].mean, p[i].mean_error, q[i].mean, q[i].mean_error, name + " mean");
        expect_within(p[i].variance, p[i].variance_error, q[i].variance, q[i].variance_error,
                      name + " variance");
        expect_within(p[i].fourth, p[i].fourth_error, q[i].fourth, q[i].fourth_error,
                      name + " fourth");
        EXPECT_LE(p[i].mean_error, (has_jumps(all[i]) ? 1e-4 : 1e-6) * p[i].mean) << name;
        const double known =
            is_exact(p[i]) ? 1e-18 * p[i].mean * p[i].mean : p[i].variance;  // how small it is
        EXPECT_LE(p[i].variance_error, (has_jumps(all[i]) ? 1e-4 : 1e-6) * known) << name;
        EXPECT_NEAR(p[i].mean, p[0].mean, p[i].mean_error + p[0].mean_error)
            << name;  // all are unbiased
    }
}

class StatedErrors : public testing::TestWithParam<unsigned> {};

TEST_P(StatedErrors, BoundTheChangeThatATighterToleranceMakes)
{
    expect_bounds_the_change_of_a_tighter_tolerance(random_scene(GetParam()),
                                                    every_plain_strategy());
}
INSTANTIATE_TEST_SUITE_P(Scenes, StatedErrors, testing::Range(0U, 12U));

TEST(StatedErrorsOf, SixLightsThatInterlock)
{
    Scene scene = random_scene(6);
    const Probe& probe = scene.probes[0];
    scene.surfaces.clear(), scene.lights.clear();
    for (int i = 0; i < 6; ++i) {
        const Vec3<double> away(0.12 * std::cos(1.7 * i), 0.12 * std::sin(2.3 * i), 0.03 * i);
        scene.lights.push_back(
            make_light(probe.position + probe.normal + away, 0.3 + 0.02 * i, Vec3<double>(1 + i)));
    }
    expect_bounds_the_change_of_a_tighter_tolerance(
        scene, strategies_of({"uniform/balance", "all/power/union", "power/cutoff",
                              "uniform/maximum/union", "all/cutoff", "brdf"}));
}

}  // namespace
}  // namespace mis
