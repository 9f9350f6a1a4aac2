// Predictions against closed forms, one-dimensional integrals, and what must not change them.
#include "mis/predict/predict.h"

#include "tests/predict/predict_cases.h"
#include "tests/support/irradiance.h"
#include "tests/support/quadrature.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace mis {
namespace {

constexpr double pi_ = std::numbers::pi;

/// The true figure lies within the stated error, which is small itself.
void expect_figure(double value, double error, double truth, double relative)
{
    EXPECT_LE(std::abs(value - truth), error + 4e-15 * std::abs(truth))
        << "value " << value << " truth " << truth;
    EXPECT_LE(error, relative * std::abs(truth)) << "value " << value;
}

/// Moments of cos θ over a uniform cap of half-angle σ about a direction at angle β, with nothing
/// that cancels.
struct CapCosine {
    double mean, variance;
    CapCosine(double sigma, double beta)
    {
        const double v = 2 * std::pow(std::sin(sigma / 2), 2);
        mean = std::cos(beta) * (1 - v / 2);
        variance = std::pow(std::cos(beta), 2) * v * v / 12 +
                   std::pow(std::sin(beta), 2) * (v / 2 - v * v / 6);
    }
};

/// Of the one grey light, as it is kept.
double emitted(const Light& light) { return luminance(radiance(light)); }

double solid_angle(double sigma) { return 4 * pi_ * std::pow(std::sin(sigma / 2), 2); }

TEST(Predict, LightAloneOnLambertHasItsClosedForm)
{
    constexpr double albedo = 0.6;
    for (const double sigma : {1.2, 0.5, 1e-2, 1e-4, 1e-6})
        for (const double beta : {0.0, 0.3}) {
            if (sigma < 1e-3 && beta == 0) continue;  // the next test
            Scene scene = empty_scene(lambert(albedo));
            scene.lights.push_back(light_at(direction(beta, 1), sigma, 3));
            const double radiance = emitted(scene.lights[0]);
            const Predicted p = predict_one(scene, "uniform/light");
            const CapCosine cosine(sigma, beta);
            const double scale = albedo / pi_ * radiance * solid_angle(sigma);
            SCOPED_TRACE(testing::Message() << "sigma " << sigma << " beta " << beta);
            expect_figure(p.mean, p.mean_error,
                          albedo * radiance * std::pow(std::sin(sigma), 2) * std::cos(beta), 1e-6);
            expect_figure(p.variance, p.variance_error, scale * scale * cosine.variance, 1e-6);
        }
}

TEST(Predict, UnderTheZenithTheValueIsUniformInItsRange)
{
    Scene scene = empty_scene(lambert(0.5));
    constexpr double sigma = 0.8;
    scene.lights.push_back(light_at(direction(0), sigma, 2));
    const Predicted p = predict_one(scene, "power/light");
    const double range = 2 * std::pow(std::sin(sigma / 2), 2) * 0.5 / pi_ *
                         emitted(scene.lights[0]) * solid_angle(sigma);
    expect_figure(p.variance, p.variance_error, range * range / 12, 1e-6);
    expect_figure(p.fourth, p.fourth_error, std::pow(range, 4) / 80, 1e-5);
}

TEST(Predict, TinyCapsKeepTheirDigitsOrSayThatTheyLostThem)
{
    for (const double radius : {1e-8, 1e-12, 1e-16, 1e-20, 1e-25}) {
        constexpr double beta = 0.5;
        Scene scene = empty_scene(lambert(0.5));
        scene.lights.push_back(
            make_light_of_power(direction(beta) * 2.0, radius, Vec3<double>(40)));
        const double sine = radius / 2, bright = emitted(scene.lights[0]);
        const double mean = 0.5 * bright * sine * sine * std::cos(beta);
        const double variance =
            mean * mean * std::pow(std::tan(beta) * sine, 2) / 4;  // to order σ²
        SCOPED_TRACE(radius);
        for (const char* strategy : {"uniform/light", "solid-angle/light/union"}) {
            const Predicted p = predict_one(scene, strategy);
            expect_figure(p.mean, p.mean_error, mean, 1e-6);
            EXPECT_LE(std::abs(p.variance - variance), p.variance_error + 1e-6 * variance);
            EXPECT_LT(p.variance_error, 1e-13 * mean * mean);
        }
        const Predicted brdf =
            predict_one(scene, "brdf");  // p f L cos/p²: hits with probability sin²σ cos β
        EXPECT_NEAR(brdf.variance, std::pow(0.5 * bright, 2) * sine * sine * std::cos(beta),
                    1e-6 * brdf.variance);
    }
}

TEST(Predict, BsdfAloneOnLambertIsHitOrMiss)
{
    for (const double sigma : {1.0, 0.1, 1e-3}) {
        Scene scene = empty_scene(lambert(0.7));
        scene.lights.push_back(light_at(direction(0.4), sigma, 3));
        const double hit = std::pow(std::sin(sigma), 2) * std::cos(0.4),
                     value = 0.7 * emitted(scene.lights[0]);
        for (const char* strategy : {"brdf", "cosine"}) {
            const Predicted p = predict_one(scene, strategy);
            expect_figure(p.variance, p.variance_error, value * value * hit * (1 - hit), 1e-6);
            expect_figure(p.fourth, p.fourth_error,
                          std::pow(value, 4) * hit * (1 - hit) * (1 - 3 * hit * (1 - hit)), 1e-5);
        }
    }
}

/// Irradiance per radiance of a sphere that the horizon cuts.
double clipped(double sine, double cos_beta)
{
    return sine * sine * exact_irradiance_over_sin2(sine, cos_beta);
}

TEST(Predict, TheOrderOfItsPassesChangesNoBit)
{
    const Scene scene = random_scene(3);
    const std::vector<Strategy> all = every_plain_strategy();
    std::size_t passes = 0;
    const AnyExecutor backwards{1, [&](std::size_t n, const auto& body) {
                                    passes = n;
                                    while (n-- > 0) body(n);
                                }};
    const std::vector<Predicted> p = predict(scene, scene.probes[0], all),
                                 q = predict(scene, scene.probes[0], all, {},
                                             {.executor = &backwards});
    EXPECT_GT(passes, 1);
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(p[i].variance, q[i].variance) << name_of(all[i]);
        EXPECT_EQ(p[i].fourth_error, q[i].fourth_error) << name_of(all[i]);
    }
}

TEST(Predict, EndsOnceItIsToldTo)
{
    Scene scene = empty_scene(lambert(0.5));
    scene.lights.push_back(light_at(direction(0.3, 2), 0.1, 1));
    std::atomic<bool> stop = false;
    const Strategy strategy = parse_strategy("all/light");
    const auto ask = [&] {
        return predict(scene, scene.probes[0], {&strategy, 1}, {}, {.stop = StopToken(&stop)});
    };
    EXPECT_GT(ask()[0].mean, 0);
    stop = true;
    EXPECT_THROW(ask(), Stopped);
}

TEST(Predict, TheHorizonCutsLights)
{
    for (const double sigma : {0.9, 0.3, 0.02})
        for (const double height :
             {0.99, 0.5, 0.0, -0.5, -0.9}) {  // of the centre over the horizon, in σ
            Scene scene = empty_scene(lambert(0.5));
            const double beta = pi_ / 2 - height * sigma;
            scene.lights.push_back(light_at(direction(beta, 2), sigma, 1));
            const double mean =
                0.5 / pi_ * emitted(scene.lights[0]) * clipped(std::sin(sigma), std::cos(beta));
            for (const char* strategy :
                 {"uniform/light", "all/balance", "uniform/maximum/one-sample"}) {
                const Predicted p = predict_one(scene, strategy);
                EXPECT_NEAR(p.mean, mean, 1e-11 * mean + p.mean_error) << strategy;
                EXPECT_LE(p.mean_error, 1e-5 * p.mean) << strategy;
            }
        }
}

/// A sphere so near that its cap is all but a hemisphere.
TEST(Predict, PointJustAboveALight)
{
    Scene scene = empty_scene(lambert(0.5));
    constexpr double gap = 1e-6;
    scene.lights.push_back(make_light({0, 0, 1 + gap}, 1, Vec3<double>(2)));
    const double sin2 = 1 / ((1 + gap) * (1 + gap)),
                 cosine = std::sqrt(gap * (2 + gap)) / (1 + gap);
    const Predicted p = predict_one(scene, "uniform/light");
    EXPECT_NEAR(p.mean, 0.5 * 2 * sin2, 1e-9 * p.mean);
    const double scale = 0.5 / pi_ * 2 * 2 * pi_ * (1 - cosine);
    EXPECT_NEAR(p.variance, scale * scale * std::pow(1 - cosine, 2) / 12, 1e-6 * p.variance);
    scene.probes[0].normal = scene.probes[0].outgoing = direction(1.2);  // cut by the horizon
    for (const char* strategy : {"uniform/light", "uniform/balance", "brdf"}) {
        const Predicted cut = predict_one(scene, strategy);
        EXPECT_NEAR(cut.mean, 0.5 * 2 / pi_ * clipped(std::sqrt(sin2), std::cos(1.2)), 1e-9)
            << strategy;
        EXPECT_LE(cut.variance_error, 1e-6 * cut.variance) << strategy;
    }
}

/// One light at the zenith and Lambert: all densities depend on θ alone, so every strategy is a
/// plain integral.
struct ZenithCase {
    double sigma = 0.9, albedo = 0.5, radiance = 2, l = 1, b = 1;
    double light_pdf() const { return 1 / solid_angle(sigma); }

    /// Variance of the multi-sample model; switches: cosines at which the weights jump.
    template <class Weight>
    double variance(const Weight& light_weight, std::vector<double> switches) const
    {
        switches.push_back(std::cos(sigma)), switches.push_back(1);
        std::sort(switches.begin(), switches.end());
        double l1 = 0, l2 = 0, b1 = 0, b2 = 0;
        for (std::size_t i = 0; i + 1 < switches.size(); ++i) {
            if (switches[i] < std::cos(sigma) || switches[i + 1] > 1) continue;
            const auto over = [&](const auto& f) {
                return integral<64>(switches[i], switches[i + 1],
                                    [&](double c) { return 2 * pi_ * f(c); });
            };
            const auto value = [&](double c) { return albedo / pi_ * c * radiance; };
            const auto weight = [&](double c) {
                return light_weight(l * light_pdf(), b * c / pi_);
            };
            l1 += over([&](double c) { return weight(c) * value(c); }) / l;
            l2 +=
                over([&](double c) { return std::pow(weight(c) * value(c) / l, 2) / light_pdf(); });
            b1 += over([&](double c) { return (1 - weight(c)) * value(c); }) / b;
            b2 += over(
                [&](double c) { return std::pow((1 - weight(c)) * value(c) / b, 2) / (c / pi_); });
        }
        return l * (l2 - l1 * l1) + b * (b2 - b1 * b1);
    }
};

TEST(Predict, EveryHeuristicMatchesItsOneDimensionalIntegral)
{
    const auto balance = [](double l, double b) { return l / (l + b); };
    const auto power = [](double l, double b) { return l * l / (l * l + b * b); };
    const auto maximum = [](double l, double b) { return l >= b ? 1.0 : 0.0; };
    const auto cutoff = [&](double l, double b) {
        return b < 0.1 * l ? 1 : l < 0.1 * b ? 0 : balance(l, b);
    };
    for (const auto& [l, b] : {std::array{1.0, 1.0}, std::array{3.0, 2.0}, std::array{1.0, 20.0}}) {
        ZenithCase c{.l = l, .b = b};
        Scene scene = empty_scene(lambert(c.albedo));
        scene.lights.push_back(light_at(direction(0), c.sigma, c.radiance));
        c.radiance = emitted(scene.lights[0]);
        const std::string counts = "@" + std::to_string(int(l)) + "+" + std::to_string(int(b));
        const auto expect = [&](const std::string& name, double variance, double relative) {
            const Predicted p = predict_one(scene, name + counts);
            SCOPED_TRACE(name + counts);
            expect_figure(p.variance, p.variance_error, variance, relative);
        };
        const double even =
            l * c.light_pdf() * pi_ / b;  // the cosine at which both densities agree
        expect("uniform/balance", c.variance(balance, {}), 1e-6);
        expect("power/power/union", c.variance(power, {}), 1e-6);
        expect("uniform/maximum", c.variance(maximum, {even}), 1e-4);
        expect("all/cutoff", c.variance(cutoff, {even / 10, even * 10}), 1e-4);
    }
}

TEST(Predict, OneSampleBalanceIsTheMixtureOfTheDensities)
{
    ZenithCase c;
    Scene scene = empty_scene(lambert(c.albedo));
    scene.lights.push_back(light_at(direction(0), c.sigma, c.radiance));
    c.radiance = emitted(scene.lights[0]);
    const double second = integral<64>(std::cos(c.sigma), 1, [&](double x) {
        const double f = c.albedo / pi_ * x * c.radiance;
        return 2 * pi_ * f * f / (0.5 * c.light_pdf() + 0.5 * x / pi_);
    });
    const double mean = c.albedo * c.radiance * std::pow(std::sin(c.sigma), 2);
    const Predicted p = predict_one(scene, "uniform/balance/one-sample");
    expect_figure(p.variance, p.variance_error, second - mean * mean, 1e-6);
}

/// Three disjoint lights and what each does alone.
struct Apart {
    Scene scene = empty_scene(lambert(0.5));
    std::vector<Predicted> alone;
    Apart()
    {
        scene.lights = {light_at(direction(0.3, 0), 0.2, 5), light_at(direction(0.9, 2), 0.4, 1),
                        light_at(direction(1.1, 4), 0.01, 700)};
        for (const Light& light : scene.lights) {
            Scene single = scene;
            single.lights = {light};
            alone.push_back(predict_one(single, "uniform/light"));
        }
    }
};

TEST(Predict, ChoosingAmongDisjointLightsFollowsFromEachAlone)
{
    const Apart apart;
    double mean = 0, second = 0, all = 0;
    for (const Predicted& p : apart.alone) {
        mean += p.mean, all += p.variance;
        second += 3 * (p.variance + p.mean * p.mean);  // Σ S_i/P_i
    }
    for (const char* strategy : {"uniform/light", "uniform/light/union"}) {
        const Predicted p = predict_one(apart.scene, strategy);
        expect_figure(p.variance, p.variance_error, second - mean * mean, 1e-6);
    }
    const Predicted p = predict_one(apart.scene, "all/light");
    expect_figure(p.variance, p.variance_error, all, 1e-6);
}

TEST(Predict, MoreDrawsDivideTheCumulants)
{
    const Apart apart;
    const Predicted one = predict_one(apart.scene, "power/light"),
                    four = predict_one(apart.scene, "power/light@4+0");
    EXPECT_NEAR(four.variance, one.variance / 4, 1e-6 * four.variance);
    const double cumulant = one.fourth - 3 * one.variance * one.variance;
    EXPECT_NEAR(four.fourth, cumulant / 64 + 3 * four.variance * four.variance, 1e-6 * four.fourth);
}

TEST(Predict, NearLightsHideFarOnes)
{
    constexpr double beta = 0.5, wide = 0.3, narrow = 0.1;
    for (const double radiance : {0.0, 7.0}) {  // a black light hides, too
        Scene scene = empty_scene(lambert(0.5));
        scene.lights = {light_at(direction(beta), wide, 2, 5),
                        light_at(direction(beta), narrow, radiance, 1)};
        const double s1 = std::pow(std::sin(wide), 2), s2 = std::pow(std::sin(narrow), 2);
        const double mean = 0.5 * std::cos(beta) *
                            (emitted(scene.lights[0]) * (s1 - s2) + emitted(scene.lights[1]) * s2);
        const std::vector<Strategy> all = every_plain_strategy();
        const std::vector<Predicted> predicted = predict(scene, scene.probes[0], all);
        for (std::size_t i = 0; i < all.size(); ++i)
            EXPECT_NEAR(predicted[i].mean, mean, 1e-9 + predicted[i].mean_error) << name_of(all[i]);
    }
}

TEST(Predict, ASphereInTheWayHidesWhatItCovers)
{
    constexpr double beta = 0.5;
    Scene scene = empty_scene(lambert(0.5));
    scene.lights.push_back(light_at(direction(beta), 0.3, 2, 5));
    scene.surfaces.push_back({SphereSurface{direction(beta), std::sin(0.1)}, 0});
    const double whole =
        0.5 * std::cos(beta) * emitted(scene.lights[0]) * std::pow(std::sin(0.3), 2);
    const double mean = whole * (1 - std::pow(std::sin(0.1) / std::sin(0.3), 2));
    for (const char* strategy : {"uniform/light", "uniform/power/union", "brdf"}) {
        const Predicted p = predict_one(scene, strategy);
        expect_figure(p.mean, p.mean_error, mean, 1e-6);
    }
    scene.surfaces[0] = {SphereSurface{direction(beta) * 20.0, 8},
                         0};  // behind the light: hides nothing
    EXPECT_NEAR(predict_one(scene, "brdf").mean, whole, 1e-9);
    scene.surfaces[0] = {SphereSurface{{0, 0, 0}, 100}, 0};  // the room that holds all
    EXPECT_NEAR(predict_one(scene, "brdf").mean, whole, 1e-9);
    scene.surfaces[0] = {SphereSurface{{0, 0, 0}, 3}, 0};  // a shell between
    EXPECT_EQ(predict_one(scene, "brdf").mean, 0);
    scene.surfaces[0] = {SphereSurface{{0, 0, -1}, 1}, 0};  // the probe stands on it
    EXPECT_NEAR(predict_one(scene, "uniform/light").mean, whole, 1e-9);
}

TEST(Predict, IdenticalLightsCountOnce)
{
    Scene scene = empty_scene(lambert(0.5));
    scene.lights.push_back(light_at(direction(0.4), 0.3, 2));
    const Predicted alone = predict_one(scene, "brdf");
    Light copy = scene.lights[0];
    copy.radiance_radius *= 5;
    scene.lights.push_back(copy);  // hidden by the first
    for (const Strategy& s : every_plain_strategy()) {
        const Predicted p = predict(scene, scene.probes[0], std::span(&s, 1)).front();
        EXPECT_NEAR(p.mean, alone.mean, p.mean_error + alone.mean_error) << name_of(s);
    }
}

TEST(Predict, WhatIsDarkIsExactlyZero)
{
    const std::vector<Strategy> all = every_plain_strategy();
    const auto expect_dark = [&](const Scene& scene) {
        for (const Predicted& p : predict(scene, scene.probes[0], all)) {
            EXPECT_EQ(p.mean, 0);
            EXPECT_EQ(p.variance, 0);
            EXPECT_EQ(p.fourth, 0);
            EXPECT_EQ(p.variance_error, 0);
        }
    };
    Scene scene = empty_scene(lambert(0.5));
    expect_dark(scene);  // no lights
    scene.lights = {light_at(direction(0.4), 0.3, 2)};
    Scene below = scene;
    below.lights = {light_at(direction(2.5), 0.3, 2)};
    expect_dark(below);
    Scene black_light = scene;
    black_light.lights = {light_at(direction(0.4), 0.3, 0)};
    expect_dark(black_light);
    Scene black = empty_scene(lambert(0));
    black.lights = scene.lights;
    expect_dark(black);
    Scene inside = scene;
    inside.lights.push_back(make_light({0, 0, 0.5}, 0.75, Vec3<double>(1)));
    expect_dark(inside);
    Scene on = scene;
    on.lights.push_back(make_light({0, 0, 0.5}, 0.5, Vec3<double>(1)));
    expect_dark(on);
    Scene from_below = scene;
    from_below.probes[0].outgoing = {0, 0.6, -0.8};
    expect_dark(from_below);
}

TEST(Predict, ALightThatIsNeverChosenIsLeftToTheBsdf)
{
    Scene scene = empty_scene(lambert(0.5));
    scene.lights = {make_light({0, 0, 2}, 0.5, Vec3<double>(0)), light_at(direction(1), 0.2, 3)};
    const Predicted brdf = predict_one(scene, "brdf");
    scene.lights.pop_back();
    EXPECT_EQ(predict_one(scene, "power/light").mean, 0);  // all weights are 0
    EXPECT_EQ(predict_one(scene, "power/balance").mean, 0);
    EXPECT_GT(brdf.mean, 0);
}

TEST(Predict, WhatNoDoubleHoldsIsInfinite)
{
    Material material = lambert(0.5);
    material.type = "blinn", material.exponent = 1e6,
    material.specular_probability = 1;  // never a diffuse draw
    Scene scene = empty_scene(material);
    scene.lights.push_back(light_at(direction(1), 0.3, 2));
    const Predicted brdf = predict_one(scene, "brdf"),
                    light = predict_one(scene, "uniform/balance");
    EXPECT_NEAR(brdf.mean, light.mean, brdf.mean_error + light.mean_error);
    EXPECT_TRUE(std::isinf(brdf.variance) && std::isinf(brdf.fourth));
    EXPECT_TRUE(std::isfinite(light.variance));
}

/// The same figures within both errors.
void expect_same(const Scene& a, const Scene& b)
{
    const std::vector<Strategy> all = every_plain_strategy();
    const std::vector<Predicted> p = predict(a, a.probes[0], all), q = predict(b, b.probes[0], all);
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_NEAR(p[i].mean, q[i].mean, p[i].mean_error + q[i].mean_error) << name_of(all[i]);
        EXPECT_NEAR(p[i].variance, q[i].variance, p[i].variance_error + q[i].variance_error)
            << name_of(all[i]);
        EXPECT_NEAR(p[i].fourth, q[i].fourth, p[i].fourth_error + q[i].fourth_error)
            << name_of(all[i]);
    }
}

TEST(Predict, RotationAndTranslationChangeNothing)
{
    for (const unsigned seed : {3U, 5U, 6U}) {
        const Scene scene = random_scene(seed);
        Scene moved = scene;
        const Frame<double> turn = frame_around(glm::normalize(Vec3<double>(0.3, -0.5, 0.7)));
        const Vec3<double> shift(3, -2, 5);
        for (Light& light : moved.lights) light.center = turn.to_world(light.center) + shift;
        for (Surface& surface : moved.surfaces) {
            auto& sphere = std::get<SphereSurface>(surface.shape);
            sphere.center = turn.to_world(sphere.center) + shift;
        }
        Probe& probe = moved.probes[0];
        probe.position = turn.to_world(probe.position) + shift;
        probe.normal = turn.to_world(probe.normal), probe.outgoing = turn.to_world(probe.outgoing);
        expect_same(scene, moved);
    }
}

TEST(Predict, TheOrderOfTheLightsChangesNothing)
{
    for (const unsigned seed : {1U, 2U, 4U}) {
        const Scene scene = random_scene(seed);
        Scene turned = scene;
        std::reverse(turned.lights.begin(), turned.lights.end());
        expect_same(scene, turned);
    }
}

TEST(Predict, ScaleChangesNothing)
{
    for (const double scale : {1e-6, 1e6}) {
        const Scene scene = random_scene(6);
        Scene scaled = scene;
        for (Light& light : scaled.lights)
            light = make_light(light.center * scale, light.radius * scale, radiance(light));
        for (Surface& surface : scaled.surfaces) {
            auto& sphere = std::get<SphereSurface>(surface.shape);
            sphere.center *= scale, sphere.radius *= scale;
        }
        scaled.probes[0].position *= scale;
        const std::vector<Strategy> some =
            strategies_of({"uniform/light", "solid-angle/power", "brdf"});
        const auto p = predict(scene, scene.probes[0], some),
                   q = predict(scaled, scaled.probes[0], some);
        for (std::size_t i = 0; i < some.size(); ++i)  // radiance · radius is rounded to float
            EXPECT_NEAR(p[i].variance, q[i].variance, 1e-6 * p[i].variance) << name_of(some[i]);
    }
}

TEST(Predict, BrightAndDimLightsTogether)
{
    Scene scene = empty_scene(lambert(0.5));
    scene.lights = {make_light({0, 0, 1.5e11}, 7e8, Vec3<double>(2e7)),
                    light_at(direction(0.8), 0.1, 1e-5, 1)};
    const double sun = 0.5 * 2e7 * std::pow(7e8 / 1.5e11, 2),
                 lamp = 0.5 * 1e-5 * std::pow(std::sin(0.1), 2) * std::cos(0.8);
    for (const char* strategy : {"uniform/light", "solid-angle/balance", "all/power"}) {
        const Predicted p = predict_one(scene, strategy);
        EXPECT_NEAR(p.mean, sun + lamp, 1e-6 * p.mean)
            << strategy;  // radiance · radius is rounded to float
        EXPECT_LE(p.variance_error, 1e-6 * p.variance) << strategy;
    }
}

}  // namespace
}  // namespace mis
