// Lists of the lights that may stand before a light: what they leave out hides nothing.
#include "mis/effects/blockers.h"

#include "mis/trace/lights.h"

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

std::vector<ShadingPoint> points_around(double size, Uniforms& uniforms,
                                        const Vec3<double>& around = Vec3<double>(0))
{
    std::vector<ShadingPoint> points(size == 0 ? 1 : 64);
    for (ShadingPoint& p : points)
        p = {.x = around +
                  Vec3<double>{uniforms.between(-size, size), 0, uniforms.between(-size, size)}};
    return points;
}

/// Of some lights, for points.
std::shared_ptr<const Blockers> blockers_of(const Lights& lights,
                                            std::span<const ShadingPoint> points,
                                            std::shared_ptr<ListBudget> budget = enough())
{
    const LightHierarchy hierarchy(lights);
    return Blockers::of(std::make_shared<FloatSpheres>(lights, hierarchy.origin()), lights, points,
                        std::move(budget));
}

std::size_t lights_in(const LightList& list)
{
    std::size_t count = 0;
    for (std::size_t g = 0; g < list.size_in_groups(); ++g)
        for (std::size_t k = 0; k < LightList::group; ++k)
            count += list.beams_of(g)[k] != 0 ? 1 : 0;
    return count;
}

struct Tally {
    int rays = 0, met = 0, differ = 0, empty = 0;
    std::size_t listed = 0, screened = 0;
};

/// Rays from points of a tile, asked of the hierarchy and of lists that were made among `listed`
/// lights.
class Comparison {
public:
    Comparison(const Lights& lights, const Lights& listed, double size, Uniforms& uniforms,
               const Vec3<double>& around = Vec3<double>(0))
        : lights_(lights), hierarchy_(lights), uniforms_(uniforms),
          points_(points_around(size, uniforms, around)), blockers_(blockers_of(listed, points_))
    {
    }

    /// To each light, half of them to its rim: does another stand before it?
    Tally hidden()
    {
        for (LightIndex j = 0; j < static_cast<LightIndex>(lights_.size()); ++j) {
            const auto list = blockers_->before(j);
            if (!list) continue;
            count(*list);
            const Light& light = lights_[static_cast<std::size_t>(j)];
            for (int i = 0; i < 40; ++i) {
                const Vec3<double> x = point(i), wi = towards(light, x, i);
                const double distance = hit_distance(light.center - x, light.radius, wi);
                if (!std::isfinite(distance)) continue;
                const bool expected = hierarchy_.hides(x, wi, {j, distance});
                const bool found =
                    hierarchy_.hides(x, wi, {j, distance}, screened(*list, x, wi, distance));
                add(expected, expected != found);
            }
        }
        return tally_;
    }

    /// The same rays, and some anywhere: which light is met?
    Tally met()
    {
        for (int i = 0; i < 40 * static_cast<int>(lights_.size()); ++i) {
            const Light& light = lights_[static_cast<std::size_t>(i) % lights_.size()];
            const Vec3<double> x = point(i);
            const Vec3<double> wi = i % 4 == 1 ? uniforms_.direction() : towards(light, x, i);
            const auto list = blockers_->along(vec_cast<float>(wi));
            if (!list) continue;
            count(*list);
            const double all = std::numeric_limits<double>::infinity();
            const LightHit expected = hierarchy_.nearest(x, wi),
                           found = hierarchy_.nearest(x, wi, screened(*list, x, wi, all));
            add(expected.light >= 0,
                expected.light != found.light || expected.distance != found.distance);
        }
        return tally_;
    }

private:
    Vec3<double> point(int i) const
    {
        return points_[static_cast<std::size_t>(i) % points_.size()].x;
    }
    Vec3<double> towards(const Light& light, const Vec3<double>& x, int i)
    {
        const Vec3<double> side = normalized(cross(light.center - x, uniforms_.direction()));
        const double out = i % 2 == 0 ? 0.9999 : uniforms_();
        return normalized(light.center + side * (light.radius * out) - x);
    }
    std::span<const ListedLight> screened(const LightList& list, const Vec3<double>& x,
                                          const Vec3<double>& wi, double distance)
    {
        const std::size_t part = blockers_->parts().holding(x, 0);
        EXPECT_LT(part, blockers_->parts().balls().size());
        const Beam ray(x - blockers_->spheres().origin, 0, wi, 0, distance);
        const std::size_t count =
            BeamTests::best.meet(ray, blockers_->spheres(), list, 1U << part, found_.data());
        tally_.screened += count;
        return std::span(found_).first(count);
    }
    void count(const LightList& list)
    {
        tally_.empty += list.beams() == 0 ? 1 : 0;
        tally_.listed += lights_in(list);
    }
    void add(bool met, bool differs)
    {
        ++tally_.rays, tally_.met += met ? 1 : 0, tally_.differ += differs ? 1 : 0;
    }

    const Lights& lights_;
    LightHierarchy hierarchy_;
    Uniforms& uniforms_;
    std::vector<ShadingPoint> points_;
    std::shared_ptr<const Blockers> blockers_;
    std::array<ListedLight, Blockers::most_in_a_list> found_{};
    Tally tally_;
};

TEST(Blockers, HoldAllThatHides)
{
    Uniforms uniforms(81);
    for (const double size : {0.0, 0.01, 0.3, 3.0}) {
        const Lights lights = lights_over_a_floor(300, uniforms);
        const Tally tally = Comparison(lights, lights, size, uniforms).hidden();
        EXPECT_EQ(tally.differ, 0) << size;
        EXPECT_GT(tally.rays, 5000) << size;
        EXPECT_GT(tally.met, 200) << size;
        EXPECT_TRUE(size > 1 || tally.listed < lights.size() * 32) << size;  // and they are short
        EXPECT_LT(tally.screened, static_cast<std::size_t>(tally.met) * 3) << size;
    }
}

TEST(Blockers, HoldAllThatIsMet)
{
    Uniforms uniforms(86);
    for (const double size : {0.0, 0.01, 0.3, 3.0}) {
        const Lights lights = lights_over_a_floor(300, uniforms);
        const Tally tally = Comparison(lights, lights, size, uniforms).met();
        EXPECT_EQ(tally.differ, 0) << size;
        EXPECT_GT(tally.rays, size > 1 ? 300 : 10'000) << size;
        EXPECT_GT(tally.met, tally.rays / (size > 1 ? 50 : 2)) << size;
        EXPECT_TRUE(size > 1 || tally.listed < static_cast<std::size_t>(tally.rays) * 64) << size;
        EXPECT_LT(tally.screened, static_cast<std::size_t>(tally.rays) * 4) << size;
    }
}

/// A million from the origin floats are a sixteenth apart; beside a far sun lamps are no less near.
TEST(Blockers, HoldAllThatIsMetFarFromTheOriginAndBesideASun)
{
    Uniforms uniforms(87);
    const Lights lamps = lights_over_a_floor(200, uniforms);
    const Vec3<double> far(1e6, -2e6, 3e6);
    Lights moved = lamps, with_sun = lamps;
    for (Light& light : moved) light.center += far;
    with_sun.push_back(make_light({1.2e11, 9e10, 0}, 7e8, Vec3<double>(1)));
    with_sun.push_back(make_light({1, 4, 1}, 1e-20, Vec3<double>(1)));
    EXPECT_EQ(Comparison(moved, moved, 0.3, uniforms, far).met().differ, 0);
    EXPECT_EQ(Comparison(moved, moved, 0.3, uniforms, far).hidden().differ, 0);
    EXPECT_EQ(Comparison(with_sun, with_sun, 0.3, uniforms).met().differ, 0);
    EXPECT_EQ(Comparison(with_sun, with_sun, 0.3, uniforms).hidden().differ, 0);
}

/// The twin: lights that are 1 % too small when lists are made are found out.
TEST(Blockers, OfLightsThatAreTooSmallAreFoundOut)
{
    Uniforms uniforms(82);
    const Lights lights = lights_over_a_floor(300, uniforms);
    Lights smaller = lights;
    for (Light& light : smaller) light.radius *= 0.99;
    EXPECT_GT(Comparison(lights, smaller, 0, uniforms).hidden().differ, 0);
    EXPECT_GT(Comparison(lights, smaller, 0, uniforms).met().differ, 0);
}

/// A list pays when it is asked for often: until then the hierarchy does as well.
TEST(Blockers, AreMadeOnceTheyWouldHavePaid)
{
    Uniforms uniforms(88);
    const Lights lights = lights_over_a_floor(60, uniforms);
    const auto blockers = blockers_of(lights, points_around(0.1, uniforms));
    const Vec3<float> up(0, 1, 0);
    EXPECT_EQ(blockers->patience_before(),
              static_cast<std::uintptr_t>(ListPatience::worth(lights.size())));
    for (std::uintptr_t i = 0; i < blockers->patience_before(); ++i) {
        EXPECT_FALSE(blockers->often_before(3));
        EXPECT_FALSE(blockers->often_along(up));
    }
    EXPECT_TRUE(blockers->often_before(3));
    EXPECT_TRUE(blockers->often_along(up));
    EXPECT_TRUE(blockers->before(4));  // at once
}

/// Where it is known how much will be asked, no list is made that cannot pay.
TEST(Blockers, AreMadeSoonOrNeverWhereItIsKnownWhatComes)
{
    for (const std::size_t lights : {33U, 1000U, 4096U}) {
        const double worth = ListPatience::worth(lights);
        EXPECT_EQ(ListPatience::of(lights, 3 * worth), ListPatience::few);
        EXPECT_EQ(ListPatience::of(lights, 1.75 * worth), static_cast<std::uintptr_t>(2 * worth));
        EXPECT_EQ(ListPatience::of(lights, 0.1 * worth), ListPatience::never);
    }
    Uniforms uniforms(88);
    const Lights lights = lights_over_a_floor(60, uniforms);
    const std::vector<ShadingPoint> points = points_around(0.1, uniforms);
    const auto with = [&](double samples) {
        const LightHierarchy hierarchy(lights);
        auto budget = std::make_shared<ListBudget>(Blockers::most_bytes);
        budget->expect_samples(samples);
        return Blockers::of(std::make_shared<FloatSpheres>(lights, hierarchy.origin()), lights,
                            points, budget);
    };
    const double points_here = static_cast<double>(points.size());
    EXPECT_FALSE(with(1 / points_here));
    ASSERT_TRUE(with(1e5));
    EXPECT_EQ(with(1e5)->patience_before(), ListPatience::few);
    EXPECT_EQ(with(1e5)->patience_along(), ListPatience::few);
}

TEST(Blockers, OfLightsSideBySideAreNone)
{
    Lights lights;
    for (int j = 0; j < 20; ++j)
        lights.push_back(make_light({0.5 * (j - 10), 3, 0}, 0.1, Vec3<double>(1)));
    Uniforms uniforms(83);
    EXPECT_EQ(Comparison(lights, lights, 0, uniforms).hidden().empty, 20);
}

TEST(Blockers, ThatAreTooManyAreNotListed)
{
    Lights lights{make_light({0, 9, 0}, 0.1, Vec3<double>(1))};
    for (std::size_t j = 0; j <= Blockers::most_in_a_list; ++j)
        lights.push_back(
            make_light({0, 2 + 0.01 * static_cast<double>(j), 0}, 0.1, Vec3<double>(1)));
    const std::vector<ShadingPoint> points(1);
    EXPECT_FALSE(blockers_of(lights, points)->before(0));
    lights.pop_back();
    const auto all = blockers_of(lights, points)->before(0);
    EXPECT_TRUE(all.has_value());
}

TEST(Blockers, AreNoneWhereTheBudgetIsSpentAndGiveBackWhatTheyTook)
{
    Uniforms uniforms(84);
    const Lights lights = lights_over_a_floor(100, uniforms);
    const std::vector<ShadingPoint> points(1);
    const std::size_t bytes =
        (lights.size() + DirectionCells::count) * sizeof(void*) + 3 * 2 * LightList::words(8);
    const auto budget = std::make_shared<ListBudget>(bytes);
    {
        const auto blockers = blockers_of(lights, points, budget);
        ASSERT_NE(blockers, nullptr);
        int listed = 0;
        for (LightIndex j = 0; j < static_cast<LightIndex>(lights.size()); ++j)
            listed += blockers->before(j) ? 1 : 0;
        EXPECT_GT(listed, 0);
        EXPECT_LT(listed, static_cast<int>(lights.size()));
        EXPECT_EQ(blockers_of(lights, points, budget), nullptr);
    }
    EXPECT_TRUE(budget->take(bytes));
    EXPECT_FALSE(budget->take(1));
    const Lights many(Blockers::most_lights + 1, lights[0]);
    EXPECT_EQ(blockers_of(many, points), nullptr);
}

TEST(Blockers, AreTheSameForManyThreads)
{
    Uniforms uniforms(85);
    const Lights lights = lights_over_a_floor(300, uniforms);
    const std::vector<ShadingPoint> points = points_around(0.1, uniforms);
    const auto budget = std::make_shared<ListBudget>(1 << 20);
    {
        const auto blockers = blockers_of(lights, points, budget);
        std::array<std::vector<const std::uint16_t*>, 4> seen;
        std::vector<std::thread> threads;
        for (auto& lists : seen)
            threads.emplace_back([&] {
                for (LightIndex j = 0; j < static_cast<LightIndex>(lights.size()); ++j) {
                    const auto list = blockers->before(j);
                    lists.push_back(list ? list->lights_of(0) : nullptr);
                }
            });
        for (std::thread& thread : threads) thread.join();
        for (const auto& lists : seen) EXPECT_EQ(lists, seen[0]);
    }
    EXPECT_TRUE(budget->take(1 << 20));  // the slower thread's list is given back, too
}

}  // namespace
}  // namespace mis
