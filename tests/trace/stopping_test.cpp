// Trees end their building once they are told to.
#include "mis/trace/embree.h"
#include "mis/trace/lights.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

TEST(LightHierarchy, EndsItsBuildingOnceItIsToldTo)
{
    Lights lights;
    for (int i = 0; i < 10'000; ++i)
        lights.push_back(
            make_light({1.0 * i, 0.5 * (i % 7), 0.3 * (i % 11)}, 0.1, Vec3<double>(1)));
    int asks = 0;
    const std::function<bool()> never = [&] { return ++asks < 0; };
    EXPECT_NO_THROW(LightHierarchy(lights, StopToken(&never)));
    const int all = asks;
    EXPECT_GT(all, 100);
    asks = 0;
    const std::function<bool()> soon = [&] { return ++asks > 50; };
    EXPECT_THROW(LightHierarchy(lights, StopToken(&soon)), Stopped);
    EXPECT_EQ(asks, 51);
}

/// A square of triangles: Embree itself asks while it builds, and the copying before does.
TEST(EmbreeTracer, EndsItsBuildingOnceItIsToldTo)
{
    Scene scene;
    Mesh mesh;
    constexpr std::uint32_t side = 300;
    for (std::uint32_t j = 0; j <= side; ++j)
        for (std::uint32_t i = 0; i <= side; ++i)
            mesh.positions.push_back({1.0 * i, 1.0 * j, 0.1 * ((i + j) % 3)});
    for (std::uint32_t j = 0; j < side; ++j)
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i, b = a + side + 1;
            mesh.triangles.push_back({a, a + 1, b + 1});
            mesh.triangles.push_back({a, b + 1, b});
        }
    scene.surfaces.push_back({mesh, 0});
    std::atomic<int> asks{0};
    const std::function<bool()> never = [&] { return ++asks < 0; };
    EXPECT_NO_THROW(EmbreeTracer(scene, StopToken(&never)));
    const int all = asks,
              of_copying = 1 + 2 + 3;  // a surface; each 65536 of vertices, of triangles
    EXPECT_GT(all, of_copying);
    for (const int after : {0, 2, of_copying}) {
        asks = 0;
        const std::function<bool()> soon = [&] { return ++asks > after; };
        EXPECT_THROW(EmbreeTracer(scene, StopToken(&soon)), Stopped) << after;
    }
}

}  // namespace
}  // namespace mis
