// Each BSDF against its formula as the textbooks write it, in double and away from where that loses
// digits.
#include "mis/bsdf/blinn.h"
#include "mis/bsdf/ggx.h"
#include "mis/bsdf/lambert.h"
#include "mis/bsdf/lecture.h"

#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// s of design §1, on the grid of random numbers.
double share(double specular, double diffuse)
{
    return std::ceil(specular / (specular + diffuse) * 0x1p32) * 0x1p-32;
}

constexpr double pi_ = std::numbers::pi;

/// body(wo, wi, n·h, wo·h) for pairs of directions above the horizon.
template <class Body> void for_each_pair(const Body& body)
{
    Uniforms uniforms(31);
    for (int i = 0; i < 1000; ++i) {
        Vec3<double> wo = uniforms.direction(), wi = uniforms.direction();
        wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
        const Vec3<double> h = normalized(wo + wi);
        body(wo, wi, h.z, dot(wo, h));
    }
}

const Vec3<double> kd{0.1, 0.2, 0.3}, ks{0.5, 0.4, 0.8};

TEST(Lambert, IsAlbedoOverPi)
{
    const Lambert bsdf({.diffuse = kd});
    for_each_pair([&](const auto& wo, const auto& wi, double, double) {
        EXPECT_NEAR(length(bsdf.evaluate(wo, wi).f - kd / pi_), 0, 1e-15);
        EXPECT_NEAR(bsdf.evaluate(wo, wi).pdf, wi.z / pi_, 1e-15);
    });
}

TEST(Lecture, IsKdPlusKsCosToTheM)
{
    constexpr double m = 30;
    const Lecture bsdf({.diffuse = kd, .specular = ks, .exponent = m});
    const double a_d = pi_ * luminance(kd), a_s = luminance(ks) * 8 * pi_ / (m + 8),
                 s = share(a_s, a_d);
    for_each_pair([&](const auto& wo, const auto& wi, double n_h, double o_h) {
        const BsdfValue<double> value = bsdf.evaluate(wo, wi);
        EXPECT_NEAR(length(value.f - (kd + ks * std::pow(n_h, m))), 0, 1e-12);
        const double spec = (m + 1) / (2 * pi_) * std::pow(n_h, m) / (4 * o_h);
        EXPECT_NEAR(value.pdf, (1 - s) * wi.z / pi_ + s * spec, 1e-11);
    });
}

TEST(Blinn, IsKdOverPiPlusTheNormalisedLobe)
{
    constexpr double m = 30;
    const Blinn bsdf({.diffuse = kd, .specular = ks, .exponent = m});
    const double s = share(luminance(ks), luminance(kd));
    for_each_pair([&](const auto& wo, const auto& wi, double n_h, double o_h) {
        const BsdfValue<double> value = bsdf.evaluate(wo, wi);
        EXPECT_NEAR(length(value.f - (kd / pi_ + ks * ((m + 8) / (8 * pi_) * std::pow(n_h, m)))), 0,
                    1e-12);
        const double spec = (m + 1) / (2 * pi_) * std::pow(n_h, m) / (4 * o_h);
        EXPECT_NEAR(value.pdf, (1 - s) * wi.z / pi_ + s * spec, 1e-11);
    });
}

/// Smith's Λ for GGX; G1 = 1/(1 + Λ), G2 = 1/(1 + Λ(wo) + Λ(wi)) (Heitz 2014, eqs. 72, 43, 99).
double lambda(double cos_theta, double alpha)
{
    const double tan2 = 1 / (cos_theta * cos_theta) - 1;
    return (std::sqrt(1 + alpha * alpha * tan2) - 1) / 2;
}

TEST(Ggx, IsDTimesG2TimesFOverTheCosines)
{
    for (const double alpha : {1.0, 0.4, 0.1}) {
        const Ggx bsdf({.diffuse = kd, .specular = ks, .alpha = alpha});
        const double s = share(luminance(ks), luminance(kd)), a2 = alpha * alpha;
        for_each_pair([&](const auto& wo, const auto& wi, double n_h, double o_h) {
            const double t = n_h * n_h * (a2 - 1) + 1, d = a2 / (pi_ * t * t);
            const double g2 = 1 / (1 + lambda(wo.z, alpha) + lambda(wi.z, alpha)),
                         g1 = 1 / (1 + lambda(wo.z, alpha));
            const Vec3<double> fresnel = ks + (Vec3<double>(1) - ks) * std::pow(1 - o_h, 5);
            const Vec3<double> f = kd / pi_ + fresnel * (d * g2 / (4 * wo.z * wi.z));
            const BsdfValue<double> value = bsdf.evaluate(wo, wi);
            EXPECT_NEAR(length(value.f - f), 0, 1e-9 * length(f));
            const double pdf = (1 - s) * wi.z / pi_ + s * d * g1 / (4 * wo.z);
            EXPECT_NEAR(value.pdf, pdf, 1e-9 * pdf);
        });
    }
}

/// With f0 = 0 and a diffuse base, the specular lobe still has its share of the draws.
TEST(Ggx, DrawsTheLobeOfABlackF0)
{
    const Ggx bsdf({.diffuse = Vec3<double>(0.5), .specular = Vec3<double>(0), .alpha = 0.01});
    const Vec3<double> wo = normalized(Vec3<double>{1, 0, 0.2}), mirror{-wo.x, -wo.y, wo.z};
    EXPECT_GT(bsdf.evaluate(wo, mirror).pdf, 10 * cosine_pdf(mirror.z));
}

}  // namespace
}  // namespace mis
