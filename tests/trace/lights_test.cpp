#include "mis/trace/lights.h"

#include "tests/support/statistics.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace mis {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

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
        if (distance < endless) hits.push_back({static_cast<LightIndex>(j), distance});
    }
    return hits;
}

bool inside_of_any(const Lights& lights, const Vec3<double>& x)
{
    return std::any_of(lights.begin(), lights.end(),
                       [&](const Light& l) { return length(l.center - x) <= l.radius; });
}

Light sphere_at(const Vec3<double>& center, double radius)
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
        for (int i = 0; i < n; ++i) {
            const Vec3<double> center = around + uniforms.in_box(extent);
            lights.push_back(sphere_at(center, uniforms.log_between(least, largest)));
        }
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
    for (int i = 0; i < 500; ++i) line.push_back(sphere_at({0.1 * i, 0, 0}, 0.06));
    with_sun.insert(with_sun.begin() + 100, sphere_at({1.2e11, 9e10, 0}, 7e8));
    list.push_back({"coincident", coincident, 3});
    list.push_back({"all in one place", Lights(100, sphere_at({1, 1, 1}, 0.5)), 4});
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

/// However many rays are under way.
TEST(LightHierarchy, AnswersManyRaysAsOneAfterTheOther)
{
    const LightCase c = cases()[2];
    const LightHierarchy hierarchy(c.lights);
    Uniforms uniforms(54);
    for (std::size_t count : {0, 1, 2, 3, 4, 5, 9, 200}) {
        std::vector<LightHierarchy::Ray> rays;
        std::vector<LightHit> nearest(count), hits;
        std::vector<int> hidden(count, -1);
        for (std::size_t i = 0; i < count; ++i) {
            rays.push_back({Vec3<double>(0, 0, 3) + uniforms.in_box(0.5), uniforms.direction()});
            const std::vector<LightHit> along = all_along(c.lights, rays[i].x, rays[i].wi);
            hits.push_back(along.empty() ? LightHit{no_light, 9} : along.back());
        }
        const auto ray_of = [&](std::size_t i) { return rays[i]; };
        hierarchy.nearest_each(count, ray_of,
                               [&](std::size_t i, const LightHit& hit) { nearest[i] = hit; });
        hierarchy.hides_each(
            count, ray_of, [&](std::size_t i, const auto&) { return hits[i]; },
            [&](std::size_t i, bool is_hidden) { hidden[i] = is_hidden ? 1 : 0; });
        for (std::size_t i = 0; i < count; ++i) {
            const LightHit one = hierarchy.nearest(rays[i].x, rays[i].wi);
            EXPECT_EQ(nearest[i].light, one.light) << i << " of " << count;
            EXPECT_EQ(nearest[i].distance, one.distance);
            EXPECT_EQ(hidden[i], hierarchy.hides(rays[i].x, rays[i].wi, hits[i]) ? 1 : 0);
        }
    }
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
    const Lights unit{sphere_at({0, 0, 0}, 1)};
    EXPECT_TRUE(LightHierarchy(unit).contains({1, 0, 0}));
    EXPECT_TRUE(LightHierarchy(unit).contains({0, 0, 0}));
    EXPECT_FALSE(LightHierarchy(unit).contains({0, 1.000001, 0}));
}

TEST(LightHierarchy, OfCoincidentLightsTheOneListedFirstIsNearer)
{
    const Lights lights{sphere_at({0, 0, 9}, 1), sphere_at({0, 0, 5}, 1), sphere_at({0, 0, 5}, 1)};
    const LightHierarchy hierarchy(lights);
    const Vec3<double> x{0, 0, 0}, wi{0, 0, 1};
    EXPECT_EQ(hierarchy.nearest(x, wi).light, 1);
    EXPECT_FALSE(hierarchy.hides(x, wi, {1, 4}));
    EXPECT_TRUE(hierarchy.hides(x, wi, {2, 4}));
    EXPECT_TRUE(hierarchy.hides(x, wi, {0, 8}));
}

/// Every third light moves, a little or to where another stood, and takes another size.
TEST(LightHierarchy, AnswersAsANewOneWhenLightsHaveMoved)
{
    for (LightCase& c : cases()) {
        SCOPED_TRACE(c.name);
        LightHierarchy hierarchy(c.lights);
        Uniforms uniforms(53);
        for (std::size_t j = 0; j < c.lights.size(); j += 3) {
            const Light before = c.lights[j];
            const Light& other =
                c.lights[static_cast<std::size_t>(uniforms.below(int(c.lights.size())))];
            const Vec3<double> away = uniforms.direction() * (3 * before.radius);
            const double radius = before.radius * uniforms.log_between(0.5, 2);
            c.lights[j] = sphere_at((j % 2 == 0 ? before : other).center + away, radius);
            hierarchy.refit(static_cast<LightIndex>(j), before);
        }
        const LightHierarchy fresh(c.lights);
        for (int i = 0; i < scaled(3000); ++i) {
            const Vec3<double> x = c.around + uniforms.in_box(c.extent);
            ASSERT_EQ(hierarchy.contains(x), inside_of_any(c.lights, x));
            if (inside_of_any(c.lights, x)) continue;
            const Light& target = c.lights[static_cast<std::size_t>(
                uniforms.below(static_cast<int>(c.lights.size())))];
            const Vec3<double> wi =
                normalized(target.center + uniforms.direction() * target.radius - x);
            const LightHit hit = hierarchy.nearest(x, wi), expected = fresh.nearest(x, wi);
            ASSERT_EQ(hit.light, nearest_of_all(c.lights, x, wi).light);
            ASSERT_EQ(hit.light, expected.light);
            ASSERT_EQ(hit.distance, expected.distance);
            for (const LightHit& along : all_along(c.lights, x, wi))
                ASSERT_EQ(hierarchy.hides(x, wi, along), fresh.hides(x, wi, along));
        }
    }
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
