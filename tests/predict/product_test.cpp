// What the choice by product is worth on glossy surfaces where nothing shades.
#include "mis/predict/predict.h"

#include "tests/predict/predict_cases.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// 32 lights in a box over a glossy floor, their radius and radiance log-uniform.
Scene lamps_over_a_floor(const Material& material)
{
    Scene scene = empty_scene(material);
    Uniforms u(32);
    for (int j = 0; j < 32; ++j) {
        const Vec3<double> center{u.between(-5, 5), u.between(-5, 5), u.between(0.7, 4)};
        const double radius = u.log_between(0.03, 0.6), radiance = u.log_between(1, 100);
        scene.lights.push_back(make_light(center, radius, Vec3<double>(radiance)));
    }
    return scene;
}

/// Relative variances of the strategies, each summed over some points and views.
std::vector<double> relative_variances(const Material& material,
                                       const std::vector<std::string_view>& names)
{
    Scene scene = lamps_over_a_floor(material);
    std::vector<double> sum(names.size());
    Uniforms u(33);
    for (int i = 0; i < 8; ++i) {
        scene.probes[0].position = {u.between(-4, 4), u.between(-4, 4), 0};
        scene.probes[0].outgoing = direction(u.between(0.2, 1.3), u.between(0, 6));
        const std::vector<Predicted> found =
            predict(scene, scene.probes[0], strategies_of(names), {.smooth = 1e-3, .jumps = 1e-2});
        for (std::size_t k = 0; k < sum.size(); ++k)
            sum[k] += found[k].variance / (found[k].mean * found[k].mean);
    }
    return sum;
}

Material glossy(const std::string& type, double exponent, double alpha)
{
    Material material;
    material.type = type, material.exponent = exponent, material.alpha = alpha;
    material.diffuse = Vec3<double>(0.1), material.specular = Vec3<double>(0.9);
    return material;
}

void expect_gain(const Material& material, double gain)
{
    const auto found = relative_variances(material, {"irradiance/balance", "product/balance"});
    EXPECT_GT(found[0], gain * found[1]) << material.type;
}

TEST(PredictProduct, IsFarBelowIrradianceOnGlossySurfaces)
{
    expect_gain(glossy("blinn", 20, 0), 5);
    expect_gain(glossy("blinn", 200, 0), 2);
    expect_gain(glossy("blinn", 2000, 0), 1.2);
    expect_gain(glossy("ggx", 0, 0.25), 2);
}

/// Where the lobe is wide, without a BSDF draw and its ray.
TEST(PredictProduct, NeedsNoBsdfDrawUnderAWideLobe)
{
    const auto found = relative_variances(glossy("blinn", 20, 0),
                                          {"product/light", "product/balance", "irradiance/light"});
    EXPECT_LT(found[0], 1.2 * found[1]);
    EXPECT_LT(found[0], 0.2 * found[2]);
}

}  // namespace
}  // namespace mis
