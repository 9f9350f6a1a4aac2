#include "mis/sampling/warp.h"

#include "tests/support/polar_grid.h"
#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <functional>

namespace mis {
namespace {

/// A draw about the z axis, and its density.
struct Warp {
    std::string name;
    std::function<Vec3<double>(const Vec2<double>&)> sample;
    std::function<double(const Vec3<double>&)> pdf;
};

std::vector<Warp> warps()
{
    std::vector<Warp> list{
        {"hemisphere", [](const Vec2<double>& u) { return sample_hemisphere(u); },
         [](const Vec3<double>&) { return hemisphere_pdf<double>(); }},
        {"cosine", [](const Vec2<double>& u) { return sample_cosine(u); },
         [](const Vec3<double>& w) { return cosine_pdf(w.z); }},
    };
    for (const double m : {0.0, 1.0, 2.5, 30.0, 1e4, 1e6})
        list.push_back(
            {"lobe " + std::to_string(m), [m](const Vec2<double>& u) { return sample_lobe(u, m); },
             [m](const Vec3<double>& w) { return lobe_pdf(w.x * w.x + w.y * w.y, w.z * w.z, m); }});
    return list;
}

TEST(Warp, DensitiesIntegrateTo1OverTheHemisphere)
{
    const PolarGrid grid({0, 0, 1}, 1e-5, 40);
    for (const Warp& warp : warps()) EXPECT_NEAR(grid.whole(warp.pdf), 1, 1e-8) << warp.name;
}

TEST(Warp, DrawsFollowTheirDensity)
{
    constexpr double false_alarm = 1e-6;  // for each warp
    const int draws = scaled(200'000);
    for (const Warp& warp : warps()) {
        const PolarGrid grid({0, 0, 1}, 1e-4);
        std::vector<double> expected = grid.integrals(warp.pdf), observed(grid.size());
        for (double& e : expected) e *= draws;
        Uniforms uniforms(6);
        for (int i = 0; i < draws; ++i) ++observed[grid.cell(warp.sample(uniforms.pair()))];
        EXPECT_GT(chi2_p_value(observed, expected), false_alarm) << warp.name;
    }
}

/// The twin: the same draws against densities that are 5 % off in their exponent.
TEST(Warp, TheSameTestSeesAnExponentThatIs5PercentOff)
{
    const int draws = 200'000;
    const PolarGrid grid({0, 0, 1}, 1e-4);
    std::vector<double> observed(grid.size());
    auto expected = grid.integrals(
        [](const Vec3<double>& w) { return lobe_pdf(w.x * w.x + w.y * w.y, w.z * w.z, 31.5); });
    for (double& e : expected) e *= draws;
    Uniforms uniforms(6);
    for (int i = 0; i < draws; ++i) ++observed[grid.cell(sample_lobe(uniforms.pair(), 30))];
    EXPECT_LT(chi2_p_value(observed, expected), 1e-6);
}

TEST(Warp, DrawsAreUnitVectorsAboveTheHorizonInFloat)
{
    Uniforms uniforms(8);
    for (int i = 0; i < 10'000; ++i) {
        const Vec2<float> u{static_cast<float>(uniforms() * 0.9999999),
                            static_cast<float>(uniforms() * 0.9999999)};
        for (const Vec3<float>& w :
             {sample_hemisphere(u), sample_cosine(u), sample_lobe(u, 7), sample_lobe(u, 1e6)}) {
            ASSERT_NEAR(static_cast<double>(length(w)), 1, 1e-6);
            ASSERT_GE(w.z, 0);
        }
    }
}

}  // namespace
}  // namespace mis
