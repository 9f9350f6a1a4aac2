// What screening rules out, the hierarchy would have ruled out: without it, every bit stays.
#include "tests/engine/bench.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// Every row is left to the hierarchy.
template <class T> void rule_out_none(const TileJob<T>&, Batch<T>& batch)
{
    batch.candidate.fill(-1);
}

template <class T> Pipeline<T> without_screening(Pipeline<T> pipeline, const Kernels<T>& kernels)
{
    int replaced = 0;
    for (auto* half : {&pipeline.light, &pipeline.bsdf})
        for (NamedStage<T>& stage : *half)
            if (stage.run == kernels.screen_meeting || stage.run == kernels.screen_hiding)
                stage.run = rule_out_none<T>, ++replaced;
    EXPECT_GT(replaced, 0);
    return pipeline;
}

struct Case {
    std::string name;
    Lights lights;
    Vec3<double> around{0};
    double extent = 1;
};

std::vector<Case> cases()
{
    Uniforms uniforms(81);
    const auto cloud = [&](Vec3<double> around, double extent, double least, double largest) {
        Lights lights;
        for (int j = 0; j < 30; ++j) {
            Vec3<double> p = uniforms.in_box(extent);
            p.y = std::abs(p.y);
            lights.push_back(make_light(around + p, extent * uniforms.log_between(least, largest),
                                        Vec3<double>(1)));
        }
        return lights;
    };
    std::vector<Case> list{
        {"overlapping", cloud(Vec3<double>(0), 1, 0.1, 0.4)},
        {"tiny", cloud(Vec3<double>(0), 1, 1e-9, 1e-3)},
        {"far from the origin", cloud(Vec3<double>(1e6), 1, 1e-3, 0.3), Vec3<double>(1e6)},
        {"small units", cloud(Vec3<double>(0), 1e-6, 1e-3, 0.3), Vec3<double>(0), 1e-6},
        {"large units", cloud(Vec3<double>(0), 1e6, 1e-3, 0.3), Vec3<double>(0), 1e6}};
    const auto twice = [](const Lights& lights) {
        Lights all = lights;
        all.insert(all.end(), lights.begin(), lights.end());
        return all;
    };
    Lights sun = eclipse(), tiny = cloud(Vec3<double>(0), 1, 1e-9, 1e-4);
    tiny.resize(15);
    sun.push_back(make_light({1e11, 1e11, 3e10}, 7e8, Vec3<double>(1e4)));
    list.push_back({"eclipse and sun", sun});
    list.push_back({"copies", twice(three_lights_apart())});
    // Narrower than a direction rounds: only the room left for rounding sees what hides the copies.
    list.push_back({"copies of tiny ones", twice(tiny)});
    return list;
}

template <class T> void expect_the_same_bits_without_screening()
{
    for (const Case& c : cases()) {
        Scene scene = probe_under(c.lights, grey_floor());
        Uniforms uniforms(82);
        scene.probes.clear();
        for (int p = 0; p < 60; ++p) {
            const Vec3<double> x = c.around + uniforms.in_box(c.extent);
            scene.probes.push_back({x, {0, 1, 0}, {0, 1, 0}, 0});
        }
        const TestScene test(scene);
        ASSERT_GT(test.probes.points.size(), 3U) << c.name;
        for (const char* name :
             {"uniform/light", "uniform/balance", "uniform/balance/union", "brdf"}) {
            const Kernels<T>& all = kernels<T>();
            const ReadyStrategy<T> ready(test.lit, parse_strategy(name), all, 1);
            Workspace<T> workspace;
            std::vector<PointResult> with(test.probes.points.size()), without(with.size());
            Tile tile = test.probes.tiles[0];
            tile.count = static_cast<std::uint32_t>(with.size());
            const auto job = ready.job(tile, test.probes.points);
            workspace.run(job, ready.pipeline(0), {.chunk = 300, .chunks = 1}, with, {}, {});
            workspace.run(job, without_screening(ready.pipeline(0), all),
                          {.chunk = 300, .chunks = 1}, without, {}, {});
            for (std::size_t p = 0; p < with.size(); ++p)
                ASSERT_EQ(with[p].radiance_sum, without[p].radiance_sum)
                    << c.name << ", " << name << ", point " << p;
        }
    }
}

TEST(Screening, ChangesNoBitInFloat) { expect_the_same_bits_without_screening<float>(); }
TEST(Screening, ChangesNoBitInDouble) { expect_the_same_bits_without_screening<double>(); }

}  // namespace
}  // namespace mis
