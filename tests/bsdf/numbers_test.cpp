// Every BSDF in float and in lanes against double, and where numbers end.
#include "mis/bsdf/bsdf.h"

#include "mis/bsdf/registry.h"

#include "tests/bsdf/bsdf_cases.h"
#include "tests/support/lanes.h"
#include "tests/support/typed.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

template <class B> class BsdfNumbers : public testing::Test {
};
TYPED_TEST_SUITE(BsdfNumbers, TestedTypes<Bsdfs>, RegisteredName);

/// Relative error that rounding directions to float leaves in a lobe: its logarithm falls by 1 over
/// the lobe's width.
double lobe_tolerance(const Material& material) { return 1e-5 + 4e-6 / lobe_width(material); }

/// Two directions that floats hold: the first above the horizon, the second drawn by the BSDF.
template <class B> std::pair<Vec3<float>, Vec3<float>> float_pair(const B& bsdf, Uniforms& uniforms)
{
    while (true) {
        Vec3<double> wo = uniforms.direction();
        wo.z = std::abs(wo.z) + 1e-4;
        const double lobe = uniforms();
        const Vec3<double> wi = bsdf.sample(normalized(wo), lobe, uniforms.pair());
        if (wi.z > 1e-4) return {vec_cast<float>(normalized(wo)), vec_cast<float>(wi)};
    }
}

TYPED_TEST(BsdfNumbers, FloatAndLanesAgreeWithDouble)
{
    using V = TestLanes<float>;
    Uniforms uniforms(21);
    for (const Material& material : materials_of(TypeParam::name)) {
        const TypeParam bsdf(material);
        for (int i = 0; i < 1000; ++i) {
            const auto [wo, wi] = float_pair(bsdf, uniforms);
            const BsdfValue<double> exact =
                bsdf.evaluate(vec_cast<double>(wo), vec_cast<double>(wi));
            const BsdfValue<float> one = bsdf.evaluate(wo, wi);
            const BsdfValue<V> lanes = bsdf.evaluate(Vec3<V>(wo), Vec3<V>(wi));
            const double tolerance = lobe_tolerance(material);
            ASSERT_NEAR(static_cast<double>(one.f.x) / exact.f.x, 1, tolerance)
                << description(material, vec_cast<double>(wo));
            ASSERT_NEAR(static_cast<double>(one.pdf) / exact.pdf, 1, tolerance)
                << description(material, vec_cast<double>(wo));
            ASSERT_NEAR(static_cast<double>(lane(lanes.f.x, 0) / one.f.x), 1, tolerance);
            ASSERT_NEAR(static_cast<double>(lane(lanes.pdf, 0) / one.pdf), 1, tolerance);
        }
    }
}

TYPED_TEST(BsdfNumbers, DrawsInFloatAndInLanesAreThoseOfDouble)
{
    using V = TestLanes<float>;
    Uniforms uniforms(22);
    for (const Material& material : materials_of(TypeParam::name)) {
        const TypeParam bsdf(material);
        for (const Vec3<double>& wo : viewers())
            for (int i = 0; i < 300; ++i) {
                const Vec2<float> u{static_cast<float>(uniforms.between(0, 0.999)),
                                    static_cast<float>(uniforms.between(0, 0.999))};
                const float lobe = uniforms() < 0.5 ? 0.F : 0.9999F;
                const Vec3<double> exact =
                    bsdf.sample(wo, static_cast<double>(lobe), Vec2<double>(u));
                const Vec3<float> one = bsdf.sample(vec_cast<float>(wo), lobe, u);
                const Vec3<V> lanes =
                    bsdf.sample(Vec3<V>(vec_cast<float>(wo)), V(lobe), Vec2<V>(u));
                ASSERT_NEAR(length(vec_cast<double>(one) - exact), 0, 2e-5)
                    << description(material, wo);
                ASSERT_NEAR(static_cast<double>(length(lane(lanes, 0) - one)), 0, 2e-5)
                    << description(material, wo);
            }
    }
}

/// Grazing directions, the narrowest lobes, and numbers at both ends of [0, 1).
TYPED_TEST(BsdfNumbers, NothingIsEverNotANumber)
{
    const std::array<float, 4> ends{0, 0x1p-24F, 0.5F, 1 - 0x1p-24F};
    for (const Material& material : materials_of(TypeParam::name)) {
        const TypeParam bsdf(material);
        for (const float height : {1.F, 0.3F, 1e-3F, 1e-6F, 1e-12F})
            for (const float a : ends)
                for (const float b : ends)
                    for (const float lobe : {0.F, 1 - 0x1p-24F}) {
                        const Vec3<float> wo = normalized(Vec3<float>{0.6F, 0.8F, height});
                        const Vec3<float> wi = bsdf.sample(wo, lobe, Vec2<float>{a, b});
                        const float size = length(wi);
                        ASSERT_NEAR(static_cast<double>(size), 1, 1e-5)
                            << description(material, vec_cast<double>(wo));
                        if (!(wi.z > 0)) continue;
                        const BsdfValue<float> value = bsdf.evaluate(wo, wi);
                        ASSERT_TRUE(std::isfinite(value.f.x) && std::isfinite(value.pdf))
                            << description(material, vec_cast<double>(wo));
                        ASSERT_GE(value.f.x, 0) << description(material, vec_cast<double>(wo));
                        ASSERT_GE(value.pdf, 0) << description(material, vec_cast<double>(wo));
                    }
    }
}

}  // namespace
}  // namespace mis
