// Beams rule out no sphere that is met, whatever floats make of both, and most that are not.
#include "mis/trace/beam.h"

#include "mis/math/sphere.h"

#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <bit>
#include <numeric>

namespace mis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
std::array<BeamTests, 2> all_tests() { return {BeamTests::by_fours, BeamTests::best}; }

Light light_at(const Vec3<double>& center, double radius)
{
    return make_light(center, radius, Vec3<double>(1));
}

/// A list of all lights, in the beams that a number's lowest bits say.
std::vector<std::uint16_t> list_of_all(std::size_t count)
{
    std::vector<ListedLight> lights(count);
    std::iota(lights.begin(), lights.end(), ListedLight{0});
    std::vector<std::uint16_t> beams(count), words(LightList::words(count));
    for (std::size_t j = 0; j < count; ++j) beams[j] = static_cast<std::uint16_t>(1U << (j % 16));
    LightList::write(lights.data(), beams.data(), count, words.data());
    return words;
}

/// Spheres that a ray grazes by a share of their radius between −10^−9 and 10^−9, or 10^-3, at
/// all distances, seen from places of several sizes.
struct Grazed {
    Vec3<double> x, wi;
    Lights lights;
};
Grazed grazed(double size, double share, Uniforms& uniforms)
{
    Grazed g{uniforms.in_box(size), uniforms.direction(), {}};
    for (int k = 0; k < 37; ++k) {
        const double radius = size * uniforms.log_between(1e-4, 1);
        const Vec3<double> side = normalized(cross(g.wi, uniforms.direction()));
        const double along = radius + size * uniforms.log_between(1e-3, 10);
        g.lights.push_back(light_at(
            g.x + g.wi * along + side * (radius * (1 + share * uniforms.between(-1, 1))), radius));
    }
    return g;
}

/// Of `g`, what its ray meets within a distance, by a list in which each light is in one beam.
std::vector<bool> met_of(const BeamTests& tests, const Grazed& g, double distance)
{
    const FloatSpheres spheres(g.lights, g.lights[0].center);
    const std::vector<std::uint16_t> words = list_of_all(g.lights.size());
    const Beam ray(g.x - spheres.origin, 0, g.wi, 0, distance);
    std::vector<bool> met(g.lights.size());
    std::array<ListedLight, 64> found{};
    for (std::uint32_t beam = 0; beam < 16; ++beam) {
        const std::size_t count =
            tests.meet(ray, spheres, LightList(words.data()), 1U << beam, found.data());
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_EQ(found[i] % 16, beam);
            EXPECT_FALSE(met[found[i]]);
            met[found[i]] = true;
        }
    }
    return met;
}

TEST(Beam, RulesOutNoSphereThatARayMeets)
{
    Uniforms uniforms(71);
    for (const BeamTests& tests : all_tests())
        for (const double size : {1e-6, 1.0, 1e5, 1e11}) {
            int hits = 0, others = 0, kept = 0;
            for (int i = 0; i < scaled(400); ++i) {
                const Grazed g = grazed(size, i % 2 == 0 ? 1e-8 : 1e-3, uniforms);
                const double distance = i % 3 == 0 ? size * uniforms() : infinity;
                const std::vector<bool> met = met_of(tests, g, distance);
                for (std::size_t j = 0; j < met.size(); ++j) {
                    const double hit =
                        hit_distance(g.lights[j].center - g.x, g.lights[j].radius, g.wi);
                    const bool is_hit = hit < infinity && hit <= distance;
                    ASSERT_TRUE(met[j] || !is_hit) << size;
                    hits += is_hit ? 1 : 0;
                    if (!is_hit && i % 2 != 0) ++others, kept += met[j] ? 1 : 0;
                }
            }
            EXPECT_GT(hits, scaled(2000)) << size;
            EXPECT_GT(others, scaled(2000)) << size;
            EXPECT_LT(kept, others / 2) << size;
        }
}

/// From a point of one ball to a point of another, past a sphere that touches the way.
TEST(Beam, BetweenTwoBallsHoldsEveryWayBetweenThem)
{
    Uniforms uniforms(72);
    for (const BeamTests& tests : all_tests()) {
        int kept = 0, others = 0;
        for (int i = 0; i < scaled(20'000); ++i) {
            const Vec3<double> a = uniforms.in_box(1), b = uniforms.in_box(3);
            const double ra = i % 7 == 0 ? 0 : uniforms.log_between(1e-3, 1),
                         rb = uniforms.log_between(1e-3, i % 5 == 0 ? 6 : 1);
            const Vec3<double> from = a + uniforms.direction() * ra,
                               to = b + uniforms.direction() * rb;
            const Vec3<double> on_way = from + (to - from) * uniforms();
            const double radius = uniforms.log_between(1e-3, 1);
            const Vec3<double> side = normalized(cross(to - from, uniforms.direction()));
            const bool touches = i % 2 == 0;
            const Light light =
                light_at(touches ? on_way + side * radius : uniforms.in_box(6), radius);
            const FloatSpheres spheres(Lights{light}, Vec3<double>(0));
            Beams beams;
            for (std::size_t k = 0; k < 5; ++k) beams.set(k, Beam::between(a, ra, b, rb));
            const std::uint32_t met = tests.meeting(beams, spheres.sphere[0]) & 31U;
            ASSERT_TRUE(met == 31U || !touches);
            if (!touches) ++others, kept += met != 0 ? 1 : 0;
        }
        EXPECT_LT(kept, others / 2);
    }
}

/// All rays from a ball, in directions within a cone.
TEST(Beam, BeforeABallHoldsEveryRayOfACone)
{
    Uniforms uniforms(73);
    for (const BeamTests& tests : all_tests()) {
        int kept = 0, others = 0;
        for (int i = 0; i < scaled(20'000); ++i) {
            const Vec3<double> a = uniforms.in_box(1), axis = uniforms.direction();
            const double ra = uniforms.log_between(1e-3, 1), sine = uniforms.between(0.01, 0.3);
            const Vec3<double> side = normalized(cross(axis, uniforms.direction()));
            const Vec3<double> wi = normalized(axis * std::sqrt(1 - sine * sine) + side * sine);
            const Vec3<double> from = a + uniforms.direction() * ra;
            const double radius = uniforms.log_between(1e-3, 1);
            const Vec3<double> out = normalized(cross(wi, uniforms.direction()));
            const bool touches = i % 2 == 0;
            const Light light =
                light_at(touches ? from + wi * uniforms.log_between(1e-3, 10) + out * radius
                                 : uniforms.in_box(9),
                         radius);
            const FloatSpheres spheres(Lights{light}, Vec3<double>(0));
            Beams beams;
            beams.set(11, {a, ra, axis, sine, infinity});
            const bool met = (tests.meeting(beams, spheres.sphere[0]) >> 11 & 1U) != 0;
            ASSERT_TRUE(met || !touches);
            if (!touches) ++others, kept += met ? 1 : 0;
        }
        EXPECT_LT(kept, others / 4);
    }
}

TEST(Beam, WithoutANumberRulesNothingOut)
{
    Lights lights(8, light_at({0, 0, 5}, 1));
    const FloatSpheres spheres(lights, {0, 0, 0});
    std::array<ListedLight, 8> found{};
    for (const BeamTests& tests : all_tests()) {
        const Beam nowhere({infinity, 0, 0}, 0, {0, 0, 1}, 0, infinity);
        EXPECT_EQ(tests.meet(nowhere, spheres, spheres.all(), 1, found.data()), 8U);
        EXPECT_EQ(tests.meet(nowhere, spheres, spheres.all(), 2, found.data()), 0U);
    }
}

}  // namespace
}  // namespace mis
