#include "mis/heuristic/registry.h"
#include "mis/predict/blockers.h"
#include "mis/predict/crossings.h"
#include "mis/predict/heuristics.h"
#include "mis/predict/patch.h"
#include "mis/predict/rule.h"
#include "tests/predict/predict_cases.h"

#include <gtest/gtest.h>

#include <random>

namespace mis {
namespace {

TEST(Rule, IsExactForPolynomials)
{
    for (int power = 0; power <= 22; power += 2) {
        double kronrod = 0, gauss = 0;
        for (std::size_t i = 0; i < Rule::nodes; ++i) {
            kronrod += rule().kronrod[i] * std::pow(rule().x[i], power);
            gauss += rule().gauss[i] * std::pow(rule().x[i], power);
        }
        EXPECT_NEAR(kronrod, 2.0 / (power + 1), 1e-14) << power;
        if (power <= 13) {
            EXPECT_NEAR(gauss, 2.0 / (power + 1), 1e-14) << power;
        }
    }
}

TEST(WeightRules, KnowTheRatiosAtWhichWeightsJump)
{
    for (const char* smooth : {"light", "balance", "power"})
        EXPECT_TRUE(weight_rule(smooth).jumps.empty()) << smooth;
    const std::vector<double>& cutoff = weight_rule("cutoff").jumps;
    ASSERT_EQ(cutoff.size(), 2u);
    EXPECT_NEAR(cutoff[0], 0.1, 1e-15);
    EXPECT_NEAR(cutoff[1], 10, 1e-13);
    const std::vector<double>& maximum = weight_rule("maximum").jumps;
    ASSERT_EQ(maximum.size(), 1u);
    EXPECT_NEAR(maximum[0], 1, 1e-15);
}

TEST(WeightRules, CoverTheRegistry)
{
    for_each_type(Heuristics{}, [&]<class H>() { EXPECT_NO_THROW(weight_rule(H::name)); });
    EXPECT_THROW(weight_rule("ballance"), std::out_of_range);
}

TEST(Crossings, AreFoundAlsoInPairsBetweenTwoLooks)
{
    const auto f = [](double x) {
        return 1 - 1000 * (x - 0.51) * (x - 0.51);
    };  // above 0 for 0.0316 on either side
    const std::vector<double> looks = looking_points(0, 1, 8), zero{0.0};
    const std::vector<double> found = crossings(f, looks, zero).front();
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR(found[0], 0.51 - std::sqrt(1e-3), 1e-10);
    EXPECT_NEAR(found[1], 0.51 + std::sqrt(1e-3), 1e-10);
}

TEST(Crossings, PassOverWhatIsNotFinite)
{
    const auto f = [](double x) { return x < 0.5 ? std::nan("") : x - 0.75; };
    const std::vector<double> looks = looking_points(0, 1, 16), zero{0.0};
    const std::vector<double> found = crossings(f, looks, zero).front();
    ASSERT_EQ(found.size(), 1u);
    EXPECT_NEAR(found[0], 0.75, 1e-12);
}

TEST(Crossings, StandByLevels)
{
    const std::vector<double> looks = looking_points(0, 1, 8), levels{0.75, 0.25, 2};
    const auto found = crossings([](double x) { return x; }, looks, levels);
    ASSERT_EQ(found.size(), 3u);
    ASSERT_EQ(found[0].size(), 1u);
    EXPECT_NEAR(found[0][0], 0.75, 1e-12);
    ASSERT_EQ(found[1].size(), 1u);
    EXPECT_NEAR(found[1][0], 0.25, 1e-12);
    EXPECT_TRUE(found[2].empty());
}

TEST(Changes, AreFoundSeveralBetweenTwoLooks)
{
    const auto steps = [](double x) { return int(10 * x); };
    const std::vector<double> looks{0.05, 0.45, 0.47}, found = changes(steps, looks);
    ASSERT_EQ(found.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], 0.1 * double(i + 1), 1e-12);
    int asked = 0;
    const auto noise = [&](double) { return ++asked; };
    EXPECT_LE(changes(noise, looks).size(), 16u);
}

std::size_t stretches_at(const Patch& patch, double phi)
{
    Meridian meridian;
    patch.meridian(phi, meridian);
    return meridian.stretches.size();
}

TEST(Patches, MeetTheSameAllAlongAnIntervalOfAzimuths)
{
    std::mt19937 random(5);
    const auto u = [&] { return 2 * std::generate_canonical<double, 53>(random) - 1; };
    for (int s = 0; s < 200; ++s) {
        Scene scene = empty_scene(lambert(0.5));
        for (int j = 0; j < 3; ++j) {  // in the tangent plane, or about it
            const double up = s % 2 == 0 ? 0 : 0.2 * u();
            scene.lights.push_back(
                make_light({3 * u(), 3 * u(), up}, 0.1 + 0.1 * j, Vec3<double>(1)));
        }
        const Sky sky = sky_of(scene, scene.probes[0]);
        if (sky.is_dark) continue;
        const Lobe lobe{.direction = direction(0.4, s), .width = 0.25};
        for (int j = 0; j < 3; ++j) {
            const auto light = static_cast<std::size_t>(j);
            const Patch patch(sky, j, sky.neighbours[light], lobe);
            for (std::size_t i = 0; i + 1 < patch.azimuths().size(); ++i) {
                const double begin = patch.azimuths()[i], size = patch.azimuths()[i + 1] - begin;
                if (size < 1e-6) continue;
                const std::size_t expected = stretches_at(patch, begin + 0.5 * size);
                for (const double share : {0.01, 0.3, 0.7, 0.99})
                    ASSERT_EQ(stretches_at(patch, begin + share * size), expected)
                        << s << " " << j << " " << begin << " + " << share << " of " << size;
            }
        }
    }
}

/// A probe on a floor of a room, a light under the ceiling.
Scene room()
{
    Scene scene = empty_scene(lambert(0.5));
    scene.lights.push_back(make_light({0.5, 0, 2}, 0.25, Vec3<double>(1)));
    const auto quad = [](Vec3<double> corner, Vec3<double> a, Vec3<double> b) {
        return Surface{Quad{corner, {a, b}}, 0};
    };
    scene.surfaces = {
        quad({-3, -3, 0}, {6, 0, 0}, {0, 6, 0}), quad({-3, -3, 3}, {6, 0, 0}, {0, 6, 0}),
        quad({3, -3, 0}, {0, 6, 0}, {0, 0, 3}), quad({-3, -3, -1}, {6, 0, 0}, {0, 6, 0})};
    return scene;
}

TEST(Blockers, WhatCannotHideALightIsLetThrough)
{
    const Scene scene = room();
    EXPECT_NO_THROW(refuse_blockers(scene, scene.probes[0]));
    Scene empty = scene;
    empty.surfaces.clear();
    EXPECT_EQ(predict_one(scene, "uniform/balance").variance,
              predict_one(empty, "uniform/balance").variance);
}

TEST(Blockers, WhatCouldIsRefusedWithTheReason)
{
    Scene scene = room();
    scene.surfaces.push_back(
        {Quad{{-0.1, -0.1, 1}, {Vec3<double>(0.2, 0, 0), Vec3<double>(0, 0.2, 0)}}, 0});
    try {
        predict_one(scene, "brdf");
        FAIL();
    } catch (const PredictError& error) {
        EXPECT_NE(std::string(error.what()).find("predict can integrate spheres only"),
                  std::string::npos)
            << error.what();
        EXPECT_NE(std::string(error.what()).find("surface 4"), std::string::npos) << error.what();
    }
    scene.surfaces.pop_back();
    Mesh triangle{.positions = {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, .triangles = {{0, 1, 2}}};
    scene.surfaces.push_back({triangle, 0});
    EXPECT_THROW(predict_one(scene, "brdf"), PredictError);
}

}  // namespace
}  // namespace mis
