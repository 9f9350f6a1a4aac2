// What is true of every BSDF of the registry, by quadrature and by draws.
#include "mis/bsdf/bsdf.h"

#include "mis/bsdf/registry.h"
#include "mis/math/moments.h"

#include "tests/bsdf/bsdf_cases.h"
#include "tests/support/statistics.h"
#include "tests/support/typed.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

template <class B> class EveryBsdf : public testing::Test {
protected:
    /// body(bsdf, material, wo) for each material of the type and each viewer.
    template <class Body> static void for_each_case(const Body& body)
    {
        for (const Material& material : materials_of(B::name))
            for (const Vec3<double>& wo : viewers()) {
                SCOPED_TRACE(description(material, wo));
                body(B(material), material, wo);
            }
    }
};
TYPED_TEST_SUITE(EveryBsdf, TestedTypes<Bsdfs>, RegisteredName);

TYPED_TEST(EveryBsdf, DrawsFollowTheDensityAndTheLostOnesAreWhatItLacksTo1)
{
    constexpr double false_alarm = 1e-7;  // for each material and viewer
    const int draws = scaled(60'000);
    this->for_each_case(
        [&](const TypeParam& bsdf, const Material& material, const Vec3<double>& wo) {
            if (!bsdf.draws()) return;
            const PolarGrid grid = grid_of(material, wo);
            std::vector<double> expected =
                grid.integrals([&](const Vec3<double>& wi) { return bsdf.evaluate(wo, wi).pdf; });
            double lost = 1;
            for (double& e : expected) lost -= e, e *= draws;
            expected.push_back(draws * std::max(lost, 0.0) + 1e-3);  // quadrature's own error
            std::vector<double> observed(expected.size());
            Uniforms uniforms(11);
            for (int i = 0; i < draws; ++i) {
                const double lobe = uniforms();
                const Vec3<double> wi = bsdf.sample(wo, lobe, uniforms.pair());
                ++observed[wi.z > 0 ? grid.cell(wi) : grid.size()];
            }
            EXPECT_GT(chi2_p_value(observed, expected), false_alarm);
        });
}

/// The lost share by equal steps in u, without a random number; s = ½ makes both lobes equal halves
/// of `lobe`.
TYPED_TEST(EveryBsdf, TheDensityAndTheLostDrawsSumTo1)
{
    for (Material material : materials_of(TypeParam::name))
        for (const Vec3<double>& wo : viewers()) {
            SCOPED_TRACE(description(material, wo));
            material.specular_probability = 0.5;
            const TypeParam bsdf(material);
            const double mass = grid_of(material, wo).whole([&](const Vec3<double>& wi) {
                return bsdf.evaluate(wo, wi).pdf;
            });
            const int steps = 250;
            double lost = 0;
            for (int a = 0; a < steps; ++a)
                for (int b = 0; b < steps; ++b)
                    for (const double lobe : {0.25, 0.75})
                        lost += bsdf.sample(wo, lobe,
                                            Vec2<double>{(a + 0.5) / steps, (b + 0.5) / steps})
                                            .z > 0
                                    ? 0
                                    : 1;
            EXPECT_NEAR(mass + lost / (2.0 * steps * steps), 1, 0.2 / steps);
        }
}

TYPED_TEST(EveryBsdf, TheAlbedoByDrawsIsTheAlbedoByQuadrature)
{
    constexpr double false_alarm = 1e-7;  // for each material and viewer
    this->for_each_case([&](const TypeParam& bsdf, const Material& material,
                            const Vec3<double>& wo) {
        const auto f_cos = [&](const Vec3<double>& wi) {
            return luminance(bsdf.evaluate(wo, wi).f) * wi.z;
        };
        const double albedo = grid_of(material, wo).whole(f_cos);
        Uniforms uniforms(12);
        Moments moments;
        for (int i = 0; i < scaled(40'000) && bsdf.draws(); ++i) {
            const double lobe = uniforms();
            const Vec3<double> wi = bsdf.sample(wo, lobe, uniforms.pair());
            moments.add(wi.z > 0 ? f_cos(wi) / bsdf.evaluate(wo, wi).pdf : 0);
        }
        const double rounding = 2e-5 * albedo;  // of the quadrature
        EXPECT_NEAR(moments.mean, albedo,
                    z_bound(false_alarm, 1) * (bsdf.draws() ? moments.mean_se() : 0) + rounding);
    });
}

TYPED_TEST(EveryBsdf, IsReciprocalAndNeverNegative)
{
    Uniforms uniforms(13);
    for (const Material& material : materials_of(TypeParam::name)) {
        const TypeParam bsdf(material);
        for (int i = 0; i < 1000; ++i) {
            Vec3<double> a = uniforms.direction(), b = uniforms.direction();
            a.z = std::abs(a.z), b.z = std::abs(b.z);
            if (i % 2 == 0)
                b = normalized(Vec3<double>{-a.x, -a.y, a.z} + b * lobe_width(material));
            const BsdfValue<double> there = bsdf.evaluate(a, b), back = bsdf.evaluate(b, a);
            ASSERT_GE(std::min({there.f.x, there.f.y, there.f.z, there.pdf}), 0);
            ASSERT_NEAR(length(there.f - back.f), 0, 1e-9 * length(there.f))
                << description(material, a);
        }
    }
}

/// A lobe that the scene prices by hand stays a density, and the estimate what it was.
TYPED_TEST(EveryBsdf, AGivenSpecularProbabilityChangesTheDensityAlone)
{
    const Vec3<double> wo = viewers()[1], wi = normalized(Vec3<double>{-0.5, 0.9, 1});
    for (Material material : materials_of(TypeParam::name)) {
        const TypeParam usual(material);
        material.specular_probability = 0;
        const TypeParam none(material);
        EXPECT_EQ(none.evaluate(wo, wi).f, usual.evaluate(wo, wi).f);
        EXPECT_NEAR(none.evaluate(wo, wi).pdf, cosine_pdf(wi.z), 1e-15);
    }
}

/// Black in both lobes draws nothing; ggx reflects at grazing angles whatever its f0.
TYPED_TEST(EveryBsdf, DrawsWhereAnyLobeCanReflect)
{
    Material material = materials_of(TypeParam::name).front();
    EXPECT_TRUE(TypeParam(material).draws());
    material.diffuse = Vec3<double>(0);
    EXPECT_EQ(TypeParam(material).draws(), TypeParam::name != "lambert");
    material.specular = Vec3<double>(0);
    EXPECT_EQ(TypeParam(material).draws(), TypeParam::name == "ggx");
}

}  // namespace
}  // namespace mis
