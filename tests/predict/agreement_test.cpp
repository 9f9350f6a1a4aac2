// Predictions against a plain Monte Carlo estimator, written for this test.
#include "mis/math/moments.h"
#include "tests/predict/naive.h"
#include "tests/predict/predict_cases.h"
#include "tests/support/statistics.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mis {
namespace {

const std::vector<std::string_view> names{"uniform/light",
                                          "power/balance",
                                          "solid-angle/power",
                                          "uniform/cutoff",
                                          "power/light/union",
                                          "uniform/balance/union",
                                          "uniform/power/one-sample",
                                          "radiant-solid-angle/maximum",
                                          "irradiance/light",
                                          "irradiance/power/union",
                                          "uniform/light/projected",
                                          "power/balance/projected",
                                          "solid-angle/cutoff/projected",
                                          "all/power/projected@2+1",
                                          "solid-angle/balance@3+2",
                                          "all/light",
                                          "all/power",
                                          "all/balance/union@2+1",
                                          "all/cutoff",
                                          "brdf",
                                          "uniform/maximum/union/one-sample",
                                          "hemisphere",
                                          "cosine"};
constexpr unsigned scenes = 24;

/// z-values of a strategy's measured mean and variance; the variance's is 0 where too few samples
/// carry it. Of a strategy without variance, both in units of rounding.
struct Scores {
    double mean = 0, variance = 0;
};

Scores scores(const Scene& scene, const Strategy& strategy, const Predicted& p, int samples)
{
    naive::Estimator estimator(scene, scene.probes[0], strategy);
    Moments m;
    for (int i = 0; i < samples; ++i) m.add(estimator.sample());
    const double n = samples;
    if (is_exact(p)) return {(m.mean / p.mean - 1) * 1e12, m.variance() / square(1e-12 * p.mean)};
    const double kurtosis = p.fourth / (p.variance * p.variance);
    Scores z{.mean = (m.mean - p.mean) / std::sqrt(p.variance / n)};
    if (n >= 1000 * kurtosis)
        z.variance = (m.variance() - p.variance) / (p.variance * std::sqrt((kurtosis - 1) / n));
    return z;
}

class Agreement : public testing::TestWithParam<unsigned> {};

// False alarm: 1e-6 over all scenes and strategies, means and variances together; the seed is
// fixed.
TEST_P(Agreement, WithAPlainEstimator)
{
    const double bound = z_bound(1e-6, 2 * int(names.size() * scenes));
    const Scene scene = random_scene(GetParam());
    const std::vector<Strategy> strategies = strategies_of(names);
    const std::vector<Predicted> predicted = predict(scene, scene.probes[0], strategies);
    for (std::size_t i = 0; i < strategies.size(); ++i) {
        const Scores z = scores(scene, strategies[i], predicted[i], scaled(60'000));
        EXPECT_LT(std::abs(z.mean), bound) << name_of(strategies[i]);
        EXPECT_LT(std::abs(z.variance), bound) << name_of(strategies[i]);
    }
}
INSTANTIATE_TEST_SUITE_P(Scenes, Agreement, testing::Range(0U, scenes));

/// A probe seen at this angle, its lobe's mirror direction at the same angle on the other side.
Scene mirror_scene(const std::string& type, double exponent, double alpha, double outgoing)
{
    Material material;
    material.type = type, material.exponent = exponent, material.alpha = alpha;
    material.diffuse = Vec3<double>(0.1), material.specular = Vec3<double>(0.5);
    return empty_scene(material, direction(outgoing, std::numbers::pi));
}

struct HardCase {
    const char* name;
    Scene scene;
};

std::vector<HardCase> hard_cases()
{
    std::vector<HardCase> cases;
    const auto add = [&](const char* name, Scene scene, const Lights& lights) -> Scene& {
        scene.lights = lights;
        cases.push_back({name, std::move(scene)});
        return cases.back().scene;
    };
    const Scene sharp = mirror_scene("blinn", 1e6, 0, 0.5),
                sharper = mirror_scene("ggx", 0, 1e-4, 0.5);
    add("sharp_lobe_inside_a_light", sharp, {light_at(direction(0.45), 0.1, 1)});
    add("sharp_lobe_at_the_edge_of_a_light", sharp, {light_at(direction(0.4), 0.1, 1)});
    add("sharp_lobe_off_a_light", sharp, {light_at(direction(0.35), 0.1, 1)});
    add("ggx_1e4_inside", sharper, {light_at(direction(0.45), 0.1, 1)});
    add("ggx_1e4_at_the_edge_of_two", sharper,
        {light_at(direction(0.4), 0.1, 1), light_at(direction(0.6), 0.1, 3)});
    add("light_as_wide_as_the_lobe", sharper, {light_at(direction(0.5001), 2e-4, 1)});
    add("grazing_sharp", mirror_scene("blinn", 1e6, 0, 1.5), {light_at(direction(1.45), 0.1, 1)});
    add("grazing_ggx", mirror_scene("ggx", 0, 0.05, 1.5707),
        {light_at(direction(1.5), 0.2, 1), light_at(direction(1.3), 0.1, 3)});
    add("three_interlocked", mirror_scene("ggx", 0, 0.3, 0.7),
        {make_light({0.2, 0, 2}, 0.8, Vec3<double>(1)),
         make_light({0.9, 0.3, 1.7}, 0.7, Vec3<double>(3)),
         make_light({0.5, -0.5, 1.9}, 0.75, Vec3<double>(0.5))});
    add("just_above_a_light", mirror_scene("blinn", 50, 0, 0.3),
        {make_light({0.6 * 1.001, 0, 0.8 * 1.001}, 1, Vec3<double>(1))});
    add("walled_in", mirror_scene("blinn", 50, 0, 0.3),
        {make_light({1, 0, 2}, 1, Vec3<double>(1)), make_light({-1, 0, 1}, 0.3, Vec3<double>(2))})
        .surfaces.push_back({SphereSurface{{0, 0, 0.5}, 1.7}, 0});
    Lights cluster;
    for (int i = 0; i < 6; ++i)
        cluster.push_back(
            make_light({0.3 + 0.25 * std::cos(1.7 * i), 0.25 * std::sin(2.3 * i), 1.5 + 0.05 * i},
                       0.4 + 0.03 * i, Vec3<double>(1 + 3 * (i % 3))));
    add("six_interlocked", mirror_scene("ggx", 0, 0.3, 0.7), cluster);
    Lights crowd;
    for (int i = 0; i < 12; ++i)
        crowd.push_back(light_at(direction(0.4 + 0.02 * i, 0.1 * i), 0.08 + 0.02 * (i % 5), 1 + i,
                                 2 + 0.3 * (7 * i % 12)));
    add("twelve_that_overlap", mirror_scene("lecture", 200, 0, 0.6), crowd);
    return cases;
}

class HardAgreement : public testing::TestWithParam<HardCase> {};

// False alarm: 1e-6 over all cases and strategies together, with those above 2e-6.
TEST_P(HardAgreement, WithAPlainEstimator)
{
    const double bound = z_bound(1e-6, 2 * int(names.size()) * 13);
    const Scene& scene = GetParam().scene;
    const std::vector<Strategy> strategies = strategies_of(names);
    const std::vector<Predicted> predicted = predict(scene, scene.probes[0], strategies);
    for (std::size_t i = 0; i < strategies.size(); ++i) {
        const int samples = scaled(60'000);
        const double kurtosis = predicted[i].fourth / std::pow(predicted[i].variance, 2);
        const Scores z = scores(scene, strategies[i], predicted[i], samples);
        if (samples >= 100 * kurtosis) {  // else too few samples carry the mean for a normal z
            EXPECT_LT(std::abs(z.mean), bound) << name_of(strategies[i]);
        }
        EXPECT_LT(std::abs(z.variance), bound) << name_of(strategies[i]);
        const double known = is_exact(predicted[i]) ? square(1e-9 * predicted[i].mean)
                                                    : predicted[i].variance;  // how small it is
        EXPECT_LE(predicted[i].variance_error, 1e-4 * known) << name_of(strategies[i]);
    }
}
INSTANTIATE_TEST_SUITE_P(Cases, HardAgreement, testing::ValuesIn(hard_cases()),
                         [](const auto& test) { return test.param.name; });

/// The twin: a radiance that is 3 % off is seen.
TEST(AgreementTwin, SeesASmallError)
{
    const Scene scene = random_scene(8);
    Scene wrong = scene;
    for (Light& light : wrong.lights) light.radiance_radius *= 1.03F;
    const std::vector<Strategy> strategies = strategies_of({"all/light"});
    const Predicted p = predict(wrong, wrong.probes[0], strategies)[0];
    EXPECT_GT(std::abs(scores(scene, strategies[0], p, 60'000).mean),
              z_bound(1e-6, 2 * int(names.size() * scenes)));
}

}  // namespace
}  // namespace mis
