// What the choice by product says of each light, of every BSDF.
#include "mis/policy/product.h"

#include "mis/bsdf/registry.h"
#include "mis/policy/irradiance.h"

#include "tests/policy/prepared.h"
#include "tests/support/irradiance.h"
#include "tests/support/lanes.h"
#include "tests/support/scenes.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <numbers>

namespace mis {
namespace {

const Vec3<double> x{0.1, -0.2, 0.3}, n = normalized(Vec3<double>{0.2, 1, -0.1});
const Vec3<double> wo = normalized(n + Vec3<double>{0.5, 0.1, 0.3});

Material material_of(std::string_view type, double exponent, double alpha)
{
    Material m;
    m.type = type, m.exponent = exponent, m.alpha = alpha;
    m.diffuse = {0.1, 0.2, 0.3}, m.specular = {0.6, 0.5, 0.4};
    return m;
}

std::vector<Material> glossy_materials()
{
    return {material_of("blinn", 20, 0), material_of("lecture", 200, 0), material_of("ggx", 0, 0.3),
            material_of("blinn", 1e6, 0), material_of("ggx", 0, 1e-3)};
}

/// A BSDF with the object that it views.
struct OwnedBsdf {
    std::shared_ptr<const void> object;
    AnyBsdf view;
    explicit OwnedBsdf(const Material& m)
        : object(make_bsdf(m)), view{object.get(), bsdf_number(m.type)}
    {
    }
};

template <class T = double>
Prepared<ProductPolicy, T> table_of(const Lights& lights, const AnyBsdf& b)
{
    return {lights, x, n, x, wo, b};
}

double luminance_of_f(const AnyBsdf& bsdf, const Vec3<double>& wi)
{
    const Frame<double> frame = frame_around(n);
    double y = 0;
    bsdf.visit([&](const auto& b) {
        y = luminance(b.evaluate(frame.to_local(wo), frame.to_local(wi)).f);
    });
    return y;
}

/// Lights over the horizon of n, all of one half-angle.
Lights lights_of_size(double half_angle, int count)
{
    Uniforms u(5);
    Lights lights;
    while (static_cast<int>(lights.size()) < count) {
        const Vec3<double> w = u.direction();
        if (dot(w, n) < 2 * half_angle) continue;
        lights.push_back(
            make_light(x + w * 3.0, 3 * std::sin(half_angle), Vec3<double>(u.log_between(1, 9))));
    }
    return lights;
}

/// A cap that the lobe does not vary in is worth f · cos · Ω, and 2 % of the lobe's albedo over π
/// more.
TEST(ProductPolicy, WeighsSmallLightsByWhatTheyReflect)
{
    const Lights lights = lights_of_size(1e-6, 40);
    for (const Material& m : glossy_materials()) {
        if (m.exponent > 1e5 || (m.type == "ggx" && m.alpha < 0.1)) continue;
        const OwnedBsdf bsdf(m);
        const double strength = luminance(m.specular);
        const double albedo =
            m.type == "ggx" ? strength / std::numbers::pi : strength * 8 / (m.exponent + 8);
        // blinn's ks is normalised: times (m + 8)/8π it is the lecture's.
        const double spread = m.type == "blinn" ? (m.exponent + 8) / (8 * std::numbers::pi) : 1;
        std::vector<double> weight;
        double total = 0;
        for (const Light& l : lights) {
            const Vec3<double> wi = normalized(l.center - x);
            weight.push_back(luminance(radiance(l)) * dot(wi, n) *
                             (luminance_of_f(bsdf.view, wi) + 0.02 * albedo * spread));
            total += weight.back();
        }
        const auto table = table_of(lights, bsdf.view);
        for (std::size_t j = 0; j < lights.size(); ++j)
            EXPECT_NEAR(table.probability(j) * total / weight[j], 1, 2e-4) << m.type << " " << j;
    }
}

/// Of a cap that holds all of the lobe no more than the lobe counts: twice as wide, it is worth
/// what its irradiance adds to the diffuse part alone.
TEST(ProductPolicy, OfALightWiderThanTheLobeCountsTheLobe)
{
    const OwnedBsdf bsdf(material_of("blinn", 1e5, 0));
    const Vec3<double> mirror = n * (2 * dot(n, wo)) - wo;
    const auto weight = [&](double half_angle) {  // over that of a lamp elsewhere
        Lights lights = lights_of_size(0.05, 1);
        lights.push_back(make_light(x + mirror * 3.0, 3 * std::sin(half_angle), Vec3<double>(1)));
        const auto table = table_of(lights, bsdf.view);
        return table.probability(1) / table.probability(0);
    };
    const double narrow = weight(1e-4), lobe = weight(0.02), wide = weight(0.04);
    EXPECT_GT(lobe / narrow, 100);  // of an area 4e4 times as large
    EXPECT_LT(lobe / narrow, 2e4);
    EXPECT_LT(wide / lobe, 1.2);  // of an area 4 times as large
}

TEST(ProductPolicy, OfALambertianSurfaceIsThePolicyOfIrradiance)
{
    const Lights lights = thirty_lights_one_dark();
    const OwnedBsdf lambert(material_of("lambert", 0, 0));
    const std::vector<double> found = table_of(lights, lambert.view).probabilities();
    EXPECT_EQ(found, (Prepared<IrradiancePolicy>(lights, x, n).probabilities()));
    const OwnedBsdf glossy(material_of("blinn", 50, 0));
    EXPECT_NE(table_of(lights, glossy.view).probabilities(), found);
}

/// However far from the lobe, and where its value underflows.
TEST(ProductPolicy, ALightThatTheSurfaceSeesHasAProbability)
{
    for (Material m : glossy_materials()) {
        m.diffuse = Vec3<double>(0);
        const OwnedBsdf bsdf(m);
        Lights lights = lights_of_size(0.01, 20);
        const Vec3<double> mirror = n * (2 * dot(n, wo)) - wo;
        lights.push_back(make_light(x + mirror * 2.0, 0.1, Vec3<double>(1e4)));
        lights.push_back(make_light(x - n * 2.0, 0.1, Vec3<double>(1e4)));
        const auto check = [&](const auto& table) {
            EXPECT_NEAR(table.sum(), 1, 1e-6);
            for (std::size_t j = 0; j + 1 < lights.size(); ++j)
                EXPECT_GT(table.probability(j), 0) << m.type << " " << j;
            EXPECT_EQ(table.probability(lights.size() - 1), 0);
        };
        check(table_of<float>(lights, bsdf.view));
        check(table_of<TestLanes<float>>(lights, bsdf.view));
        check(table_of<double>(lights, bsdf.view));
    }
}

/// A float's cosine is off by 6e-8, of which a lobe of width w makes 6e-8/w.
TEST(ProductPolicy, FloatAndLanesAgreeWithDouble)
{
    const Lights lights = thirty_lights_one_dark();
    for (const Material& m : glossy_materials()) {
        if (m.exponent > 1e5 || (m.type == "ggx" && m.alpha < 0.1)) continue;
        const OwnedBsdf bsdf(m);
        const std::vector<double> exact = table_of<double>(lights, bsdf.view).probabilities();
        const auto expect_near = [&](const std::vector<double>& found, double tolerance) {
            for (std::size_t j = 0; j < lights.size(); ++j)
                EXPECT_NEAR(found[j], exact[j], tolerance * exact[j] + 1e-12) << m.type << " " << j;
        };
        expect_near(table_of<float>(lights, bsdf.view).probabilities(), 1e-4);
        expect_near(table_of<TestLanes<float>>(lights, bsdf.view).probabilities(), 1e-4);
        expect_near(table_of<TestLanes<double>>(lights, bsdf.view).probabilities(), 1e-10);
    }
}

/// In other units and other axes the choice is the same.
TEST(ProductPolicy, DependsOnAnglesAlone)
{
    const Lights lights = thirty_lights_one_dark();
    const Frame<double> turn = frame_around(normalized(Vec3<double>{1, 2, -2}));
    const OwnedBsdf bsdf(material_of("ggx", 0, 0.2));
    Lights turned = lights;
    for (Light& l : turned) {
        l.center = turn.to_world(l.center - x) * 1e3, l.radius *= 1e3, l.radiance_radius *= 1e3F;
    }
    const Vec3<double> origin(0), m = turn.to_world(n);
    const Prepared<ProductPolicy> there(turned, origin, m, origin, turn.to_world(wo), bsdf.view);
    const std::vector<double> here = table_of(lights, bsdf.view).probabilities();
    for (std::size_t j = 0; j < lights.size(); ++j)
        EXPECT_NEAR(there.probability(j), here[j], 1e-6 * here[j] + 1e-12) << j;
}

}  // namespace
}  // namespace mis
