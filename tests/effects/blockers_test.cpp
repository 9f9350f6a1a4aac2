// Lists of the lights that may stand before a light: what they leave out hides nothing.
#include "mis/effects/blockers.h"

#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

namespace mis {
namespace {

std::shared_ptr<ListBudget> enough() { return std::make_shared<ListBudget>(1 << 24); }

/// Lights over a floor, of all sizes, some of them overlapping, and for each of every third one
/// that reaches into the way to its rim from the origin by some thousandths of its radius.
Lights lights_over_a_floor(int count, Uniforms& uniforms)
{
    Lights lights;
    for (int j = 0; j < count; ++j) {
        const Vec3<double> center{uniforms.between(-5, 5), uniforms.between(2, 6),
                                  uniforms.between(-5, 5)};
        lights.push_back(make_light(center, uniforms.log_between(1e-3, 0.5), Vec3<double>(1)));
        if (j % 3 != 0) continue;
        const double radius = lights.back().radius, share = uniforms.between(0.4, 0.8);
        const Vec3<double> side = normalized(cross(center, uniforms.direction()));
        const double reach = share * radius * uniforms.between(0, 0.004);
        const double own = radius * uniforms.log_between(0.05, 0.5);
        const Vec3<double> out = normalized(side - center * (radius / length2(center)));
        lights.push_back(make_light((center + side * radius) * share + out * (own - reach), own,
                                    Vec3<double>(1)));
    }
    return lights;
}

std::vector<ShadingPoint> points_around(double size, Uniforms& uniforms)
{
    std::vector<ShadingPoint> points(size == 0 ? 1 : 64);
    for (ShadingPoint& p : points)
        p = {.x = {uniforms.between(-size, size), 0, uniforms.between(-size, size)}};
    return points;
}

struct Tally {
    int rays = 0, hidden = 0, differ = 0, empty = 0;
    std::size_t listed = 0;
};

/// Rays to each light, half of them to its rim, asked of the hierarchy and of lists that were made
/// among `listed` lights.
Tally compare(const Lights& lights, const Lights& listed, double size, Uniforms& uniforms)
{
    const LightHierarchy hierarchy(lights), other(listed);
    const std::vector<ShadingPoint> points = points_around(size, uniforms);
    const auto blockers = Blockers::of(other, listed, points, enough());
    Tally tally;
    for (LightIndex j = 0; j < static_cast<LightIndex>(lights.size()); ++j) {
        const auto list = blockers->before(j);
        if (!list) continue;
        tally.empty += list->empty() ? 1 : 0;
        const Light& light = lights[static_cast<std::size_t>(j)];
        for (int i = 0; i < 40; ++i) {
            const Vec3<double> x = points[static_cast<std::size_t>(i) % points.size()].x;
            const Vec3<double> side = normalized(cross(light.center - x, uniforms.direction()));
            const double out = i % 2 == 0 ? 0.9999 : uniforms();
            const Vec3<double> wi = normalized(light.center + side * (light.radius * out) - x);
            const double distance = hit_distance(light.center - x, light.radius, wi);
            if (!std::isfinite(distance)) continue;
            const bool expected = hierarchy.hides(x, wi, {j, distance});
            tally.hidden += expected ? 1 : 0;
            tally.differ += hierarchy.hides(x, wi, {j, distance}, *list) != expected ? 1 : 0;
            ++tally.rays;
        }
        tally.listed += list->size();
    }
    return tally;
}

TEST(Blockers, HoldAllThatHides)
{
    Uniforms uniforms(81);
    for (const double size : {0.0, 0.01, 0.3}) {
        const Lights lights = lights_over_a_floor(300, uniforms);
        const Tally tally = compare(lights, lights, size, uniforms);
        EXPECT_EQ(tally.differ, 0) << size;
        EXPECT_GT(tally.rays, 5000) << size;
        EXPECT_GT(tally.hidden, 200) << size;
        EXPECT_LT(tally.listed, lights.size() * 32) << size;  // and they are short
    }
}

/// The twin: lights that are 1 % too small when lists are made are found out.
TEST(Blockers, OfLightsThatAreTooSmallAreFoundOut)
{
    Uniforms uniforms(82);
    const Lights lights = lights_over_a_floor(300, uniforms);
    Lights smaller = lights;
    for (Light& light : smaller) light.radius *= 0.99;
    EXPECT_GT(compare(lights, smaller, 0, uniforms).differ, 0);
}

TEST(Blockers, OfLightsSideBySideAreNone)
{
    Lights lights;
    for (int j = 0; j < 20; ++j)
        lights.push_back(make_light({0.5 * (j - 10), 3, 0}, 0.1, Vec3<double>(1)));
    Uniforms uniforms(83);
    EXPECT_EQ(compare(lights, lights, 0, uniforms).empty, 20);
}

TEST(Blockers, ThatAreTooManyAreNotListed)
{
    Lights lights{make_light({0, 9, 0}, 0.1, Vec3<double>(1))};
    for (std::size_t j = 0; j <= Blockers::most_in_a_list; ++j)
        lights.push_back(
            make_light({0, 2 + 0.01 * static_cast<double>(j), 0}, 0.1, Vec3<double>(1)));
    const LightHierarchy hierarchy(lights);
    const std::vector<ShadingPoint> points(1);
    EXPECT_FALSE(Blockers::of(hierarchy, lights, points, enough())->before(0));
    lights.pop_back();
    const LightHierarchy fewer(lights);
    EXPECT_EQ(Blockers::of(fewer, lights, points, enough())->before(0)->size(),
              Blockers::most_in_a_list);
}

TEST(Blockers, AreNoneWhereTheBudgetIsSpentAndGiveBackWhatTheyTook)
{
    Uniforms uniforms(84);
    const Lights lights = lights_over_a_floor(100, uniforms);
    const LightHierarchy hierarchy(lights);
    const std::vector<ShadingPoint> points(1);
    const std::size_t bytes = lights.size() * sizeof(void*) + 3 * sizeof(LightIndex);
    const auto budget = std::make_shared<ListBudget>(bytes);
    {
        const auto blockers = Blockers::of(hierarchy, lights, points, budget);
        ASSERT_NE(blockers, nullptr);
        int listed = 0;
        for (LightIndex j = 0; j < static_cast<LightIndex>(lights.size()); ++j)
            listed += blockers->before(j) ? 1 : 0;
        EXPECT_GT(listed, 0);
        EXPECT_LT(listed, static_cast<int>(lights.size()));
        EXPECT_EQ(Blockers::of(hierarchy, lights, points, budget), nullptr);
    }
    EXPECT_TRUE(budget->take(bytes));
    EXPECT_FALSE(budget->take(1));
    const Lights many(Blockers::most_lights + 1, lights[0]);
    EXPECT_EQ(Blockers::of(LightHierarchy(many), many, points, enough()), nullptr);
}

TEST(Blockers, AreTheSameForManyThreads)
{
    Uniforms uniforms(85);
    const Lights lights = lights_over_a_floor(300, uniforms);
    const LightHierarchy hierarchy(lights);
    const std::vector<ShadingPoint> points = points_around(0.1, uniforms);
    const auto budget = std::make_shared<ListBudget>(1 << 20);
    {
        const auto blockers = Blockers::of(hierarchy, lights, points, budget);
        std::array<std::vector<const LightIndex*>, 4> seen;
        std::vector<std::thread> threads;
        for (auto& lists : seen)
            threads.emplace_back([&] {
                for (LightIndex j = 0; j < static_cast<LightIndex>(lights.size()); ++j) {
                    const auto list = blockers->before(j);
                    lists.push_back(list ? list->data() : nullptr);
                }
            });
        for (std::thread& thread : threads) thread.join();
        for (const auto& lists : seen) EXPECT_EQ(lists, seen[0]);
    }
    EXPECT_TRUE(budget->take(1 << 20));  // the slower thread's list is given back, too
}

}  // namespace
}  // namespace mis
