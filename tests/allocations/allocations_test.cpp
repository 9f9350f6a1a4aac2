// Between set-up and the next change of lights a host's calls ask for no memory.
#include "tests/allocations/allocation_count.h"

#include "mis/bind/c.h"
#include "mis/bsdf/framed.h"
#include "mis/bsdf/lambert.h"
#include "mis/engine/direct.h"
#include "mis/engine/light_points.h"
#include "mis/heuristic/power.h"
#include "mis/policy/registry.h"
#include "mis/sampling/random.h"
#include "mis/technique/union.h"

#include "tests/engine/bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <string>
#include <vector>

namespace mis {
namespace {

/// What `work` asks for.
std::size_t allocations_of(const auto& work)
{
    const std::size_t before = allocations();
    work();
    return allocations() - before;
}

DirectNumbers<float> numbers_of(int point, int draw)
{
    const Counter counter{static_cast<std::uint32_t>(point), 0, static_cast<std::uint32_t>(draw)};
    const Words light = random_words(1, counter, Block::light),
                bsdf = random_words(1, counter, Block::bsdf);
    const auto u = [](std::uint32_t word) { return unit_number<float>(word); };
    return {choice_bits(light), {u(light[2]), u(light[3])}, u(bsdf[1]), {u(bsdf[2]), u(bsdf[3])}};
}

Vec3<double> place(int i) { return {0.02 * i - 1, 0, 0.013 * i - 0.7}; }

TEST(Allocations, AreCounted)
{
    EXPECT_EQ(allocations_of([] { operator delete(operator new(4)); }), 1u);
    EXPECT_EQ(allocations_of([] { std::vector<double> some(100); }), 1u);
    constexpr std::align_val_t wide{64};
    EXPECT_EQ(allocations_of([] { operator delete(operator new(4, wide), wide); }), 1u);
}

TEST(Allocations, ThereAreNoneInTheScalarCallsOfAnyPolicy)
{
    for_each_type(Policies{}, [&]<class Policy>() {
        const DirectLights<Policy> lights(thirty_lights_one_dark());
        DirectPoint<Policy> point(lights);
        const Lambert own(grey_floor());
        const Vec3<float> n{0, 1, 0};
        const auto occluded = [](const Vec3<float>& wi, float) { return wi.x > 0.5F; };
        float sum = 0;
        const std::size_t asked = allocations_of([&] {
            for (int i = 0; i < 100; ++i) {
                point.move_to(place(i), n);
                const FramedBsdf<Lambert, float> bsdf(own, n, n);
                const auto numbers = [&](int draw) { return numbers_of(i, draw); };
                sum += sample_direct<PowerHeuristic, UnionTechnique>(point, bsdf, occluded, numbers,
                                                                     2, 1)
                           .radiance.x;
            }
        });
        EXPECT_EQ(asked, 0u) << Policy::name;
        EXPECT_GT(sum, 0) << Policy::name;
    });
}

TEST(Allocations, ThereAreNoneWhereALightChangesAndNoTableIsMadeAnew)
{
    for_each_type(Policies{}, [&]<class Policy>() {
        DirectLights<Policy> lights(thirty_lights_one_dark());
        const Light before = lights.lights()[3],
                    after = make_light(before.center + Vec3<double>(0.01), before.radius,
                                       radiance(before));
        const std::size_t asked = allocations_of([&] {
            for (int i = 0; i < 10; ++i) lights.replace(3, i % 2 == 0 ? after : before);
        });
        if (keeps_tables<Policy>(before, after)) EXPECT_EQ(asked, 0u) << Policy::name;
        else EXPECT_GT(asked, 0u) << Policy::name;
    });
}

TEST(Allocations, OfManyPointsAreThoseOfTheFirstCall)
{
    const Scene scene = probe_under(thirty_lights_one_dark(), grey_floor());
    const HostTracer tracer([](std::span<const ShadowRay>, std::span<std::uint8_t> hidden) {
        std::ranges::fill(hidden, 0);
    });
    const LitScene lit(scene, &tracer, all_effects(scene));
    constexpr std::size_t count = 600;
    std::vector<double> x(count), y(count, 0.0), z(count, 0.3);
    std::vector<float> nothing(count, 0.0F), one(count, 1.0F), red(count), green(count),
        blue(count);
    std::vector<std::int32_t> material(count, 0);
    std::vector<std::uint32_t> id(count);
    for (std::size_t i = 0; i < count; ++i)
        x[i] = 0.001 * static_cast<double>(i), id[i] = static_cast<std::uint32_t>(i);
    const PointArrays points{
        {x, y, z}, {nothing, one, nothing}, {nothing, one, nothing}, {x, y, z}, material, {id}};
    for (const char* name : {"power/power", "product/balance", "tree/power", "brdf",
                             "irradiance/light/projected", "uniform/light/union", "all/light"}) {
        const ReadyStrategy<float> strategy(lit, parse_strategy(name), kernels<float>(), 1);
        PointLighter lighter(lit, strategy);
        const auto light = [&](std::uint64_t first) {
            lighter.light(points, first, 16, {red, green, blue});
        };
        EXPECT_GT(allocations_of([&] { light(0); }), 0u) << name;
        EXPECT_EQ(allocations_of([&] { light(16); }), 0u) << name;
        EXPECT_GT(*std::ranges::max_element(red), 0) << name;
    }
}

/// A host in C: a grey Lambertian floor under an open sky.
struct HostInC {
    int point = 0;

    static void evaluate(void*, const float[3], float f[3]) { std::fill_n(f, 3, 0.15F); }
    static float pdf(void*, const float wi[3]) { return std::max(wi[1], 0.0F) / 3.14159265F; }
    static void sample(void*, float, const float[2], float wi[3])
    {
        wi[0] = 0, wi[1] = 1, wi[2] = 0;
    }
    static int is_occluded(void*, const float[3], float) { return 0; }
    static void numbers(void* self, int draw, mis_numbers* out)
    {
        const DirectNumbers<float> u = numbers_of(static_cast<HostInC*>(self)->point, draw);
        *out = {u.choice, 0, {u.cap.x, u.cap.y}, u.lobe, {u.bsdf.x, u.bsdf.y}};
    }
};

TEST(Allocations, ThereAreNoneInTheCallsFromC)
{
    std::vector<mis_light> list;
    for (int j = 0; j < 40; ++j)
        list.push_back({{0.3 * j - 6, 2 + 0.01 * j, 0.1 * j}, 0.2, {1.0 + j, 1, 1}});
    for (const std::string policy : {"uniform", "power", "irradiance", "product", "tree"}) {
        mis_lights* lights = nullptr;
        ASSERT_EQ(mis_lights_create((policy + "/power").c_str(), list.data(), list.size(), &lights,
                                    nullptr, 0),
                  MIS_OK);
        mis_point* point = nullptr;
        ASSERT_EQ(mis_point_create(lights, &point), MIS_OK);
        HostInC host;
        const mis_bsdf bsdf{&host, HostInC::evaluate, HostInC::pdf, HostInC::sample};
        const mis_rays rays{&host, HostInC::is_occluded};
        const mis_random random{&host, HostInC::numbers};
        float sum = 0;
        const std::size_t asked = allocations_of([&] {
            for (host.point = 0; host.point < 100; ++host.point) {
                const Vec3<double> x = place(host.point);
                const double at[3] = {x.x, x.y, x.z};
                const float n[3] = {0, 1, 0};
                float radiance[3] = {0, 0, 0};
                mis_point_move_to(point, at, n);
                mis_point_sample(point, &bsdf, &rays, &random, radiance);
                sum += radiance[0];
            }
        });
        EXPECT_EQ(asked, 0u) << policy;
        EXPECT_GT(sum, 0) << policy;
        mis_point_destroy(point);
        mis_lights_destroy(lights);
    }
}

}  // namespace
}  // namespace mis
