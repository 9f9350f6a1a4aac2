#include "mis/trace/lights.h"

#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mis {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// All lights one after the other: what the hierarchy has to say.
LightHit nearest_of_all(const Lights& lights, const Vec3<double>& x, const Vec3<double>& wi)
{
    LightHit best;
    for (std::size_t j = 0; j < lights.size(); ++j) {
        const double distance = hit_distance(lights[j].center - x, lights[j].radius, wi);
        if (distance < best.distance) best = {static_cast<LightIndex>(j), distance};
    }
    return best;
}

std::vector<LightHit> all_along(const Lights& lights, const Vec3<double>& x, const Vec3<double>& wi)
{
    std::vector<LightHit> hits;
    for (std::size_t j = 0; j < lights.size(); ++j) {
        const double distance = hit_distance(lights[j].center - x, lights[j].radius, wi);
        if (distance < infinity) hits.push_back({static_cast<LightIndex>(j), distance});
    }
    return hits;
}

bool inside_of_any(const Lights& lights, const Vec3<double>& x)
{
    return std::any_of(lights.begin(), lights.end(),
                       [&](const Light& l) { return length(l.center - x) <= l.radius; });
}

Light light_at(const Vec3<double>& center, double radius)
{
    return make_light(center, radius, Vec3<double>(1));
}

/// Sets of lights that are hard for boxes: overlapping, coincident, on a line, tiny beside huge,
/// near a far sun.
struct LightCase {
    std::string name;
    Lights lights;
    double extent;  ///< of the points to look from
    Vec3<double> around{0};
};

std::vector<LightCase> cases()
{
    Uniforms uniforms(51);
    const auto cloud = [&](int n, double extent, double least, double largest,
                           Vec3<double> around = Vec3<double>(0)) {
        Lights lights;
        for (int i = 0; i < n; ++i)
            lights.push_back(
                light_at(around + uniforms.in_box(extent), uniforms.log_between(least, largest)));
        return lights;
    };
    std::vector<LightCase> list{
        {"one", cloud(1, 1, 0.5, 0.5), 4},
        {"five", cloud(5, 1, 0.1, 0.5), 4},
        {"overlapping", cloud(300, 1, 0.2, 0.6), 3},
        {"tiny and huge", cloud(1000, 10, 1e-4, 3), 30},
        {"far from the origin", cloud(500, 10, 0.1, 2, Vec3<double>(1e6)), 20, Vec3<double>(1e6)},
        {"millimetres", cloud(500, 1e-3, 1e-6, 3e-4), 3e-3},
        {"one, tiny from afar", cloud(1, 1, 1e-4, 1e-4), 1e4},
        {"tiny from afar", cloud(300, 1, 1e-6, 1e-3), 1e4}};
    Lights coincident = cloud(50, 1, 0.2, 0.5), line, with_sun = cloud(200, 5, 0.05, 0.5);
    for (int i = 0; i < 150; ++i)
        coincident.push_back(coincident[static_cast<std::size_t>(i) % 50]);
    for (int i = 0; i < 500; ++i) line.push_back(light_at({0.1 * i, 0, 0}, 0.06));
    with_sun.insert(with_sun.begin() + 100, light_at({1.2e11, 9e10, 0}, 7e8));
    list.push_back({"coincident", coincident, 3});
    list.push_back({"all in one place", Lights(100, light_at({1, 1, 1}, 0.5)), 4});
    list.push_back({"on a line", line, 30});
    list.push_back({"with a far sun", with_sun, 10});
    return list;
}

/// body(case, hierarchy, x, wi) for rays from outside all lights, mostly towards one of them, some
/// along an axis.
template <class Body> void for_each_ray(const Body& body)
{
    for (const LightCase& c : cases()) {
        SCOPED_TRACE(c.name);
        const LightHierarchy hierarchy(c.lights);
        Uniforms uniforms(52);
        for (int i = 0; i < scaled(3000); ++i) {
            const Vec3<double> x = c.around + uniforms.in_box(c.extent);
            if (inside_of_any(c.lights, x)) continue;
            const Light& target = c.lights[static_cast<std::size_t>(
                uniforms.below(static_cast<int>(c.lights.size())))];
            Vec3<double> wi = normalized(target.center + uniforms.direction() * target.radius - x);
            if (i % 8 == 0) wi = uniforms.direction();
            if (i % 8 == 1) wi = Vec3<double>(0), wi[i / 8 % 3] = i % 16 == 1 ? 1 : -1;
            body(c, hierarchy, x, wi);
        }
    }
}

TEST(LightHierarchy, TheNearestIsThatOfALoopOverAll)
{
    int met = 0;
    for_each_ray([&](const LightCase& c, const LightHierarchy& hierarchy, const auto& x,
                     const auto& wi) {
        const LightHit expected = nearest_of_all(c.lights, x, wi), found = hierarchy.nearest(x, wi);
        EXPECT_EQ(found.light, expected.light);
        EXPECT_EQ(found.distance, expected.distance);
        met += found.light >= 0 ? 1 : 0;
    });
    EXPECT_GT(met, scaled(10'000));
}

TEST(LightHierarchy, VisitsEveryLightAlongARayOnce)
{
    for_each_ray(
        [&](const LightCase& c, const LightHierarchy& hierarchy, const auto& x, const auto& wi) {
            std::vector<LightHit> found;
            hierarchy.for_each_along(x, wi, [&](const LightHit& hit) { found.push_back(hit); });
            std::sort(found.begin(), found.end(),
                      [](const LightHit& a, const LightHit& b) { return a.light < b.light; });
            const std::vector<LightHit> expected = all_along(c.lights, x, wi);
            ASSERT_EQ(found.size(), expected.size());
            for (std::size_t i = 0; i < found.size(); ++i)
                EXPECT_EQ(found[i].light, expected[i].light);
        });
}

TEST(LightHierarchy, HidesWhatIsNotTheNearest)
{
    int hidden = 0;
    for_each_ray(
        [&](const LightCase& c, const LightHierarchy& hierarchy, const auto& x, const auto& wi) {
            const LightHit nearest = nearest_of_all(c.lights, x, wi);
            for (const LightHit& hit : all_along(c.lights, x, wi)) {
                EXPECT_EQ(hierarchy.hides(x, wi, hit), hit.light != nearest.light);
                hidden += hit.light != nearest.light ? 1 : 0;
            }
        });
    EXPECT_GT(hidden, scaled(1000));
}

TEST(LightHierarchy, ContainsTheInsideAndTheSurface)
{
    for (const LightCase& c : cases()) {
        const LightHierarchy hierarchy(c.lights);
        Uniforms uniforms(53);
        for (int i = 0; i < scaled(3000); ++i) {
            const Light& light = c.lights[static_cast<std::size_t>(
                uniforms.below(static_cast<int>(c.lights.size())))];
            const Vec3<double> x =
                light.center + uniforms.direction() * (light.radius * uniforms.between(0.9, 1.1));
            EXPECT_EQ(hierarchy.contains(x), inside_of_any(c.lights, x)) << c.name;
        }
    }
    const Lights unit{light_at({0, 0, 0}, 1)};
    EXPECT_TRUE(LightHierarchy(unit).contains({1, 0, 0}));
    EXPECT_TRUE(LightHierarchy(unit).contains({0, 0, 0}));
    EXPECT_FALSE(LightHierarchy(unit).contains({0, 1.000001, 0}));
}

TEST(LightHierarchy, OfCoincidentLightsTheOneListedFirstIsNearer)
{
    const Lights lights{light_at({0, 0, 9}, 1), light_at({0, 0, 5}, 1), light_at({0, 0, 5}, 1)};
    const LightHierarchy hierarchy(lights);
    const Vec3<double> x{0, 0, 0}, wi{0, 0, 1};
    EXPECT_EQ(hierarchy.nearest(x, wi).light, 1);
    EXPECT_FALSE(hierarchy.hides(x, wi, {1, 4}));
    EXPECT_TRUE(hierarchy.hides(x, wi, {2, 4}));
    EXPECT_TRUE(hierarchy.hides(x, wi, {0, 8}));
}

TEST(LightHierarchy, WithoutLightsMeetsNone)
{
    const Lights none;
    const LightHierarchy hierarchy(none);
    EXPECT_EQ(hierarchy.nearest({0, 0, 0}, {0, 0, 1}).light, no_light);
    EXPECT_FALSE(hierarchy.contains({0, 0, 0}));
}

}  // namespace
}  // namespace mis
