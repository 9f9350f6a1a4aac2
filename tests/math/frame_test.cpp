#include "mis/math/frame.h"

#include "tests/support/lanes.h"
#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

/// The largest deviation of a frame from an orthonormal, right-handed one about z.
template <class T> double error_of(const Frame<T>& f, const Vec3<T>& z)
{
    double worst = 0;
    const auto consider = [&](T found, double expected) {
        worst = std::max(worst, std::abs(static_cast<double>(found) - expected));
    };
    consider(dot(f.x, f.x), 1), consider(dot(f.y, f.y), 1);
    consider(dot(f.x, f.y), 0), consider(dot(f.x, f.z), 0), consider(dot(f.y, f.z), 0);
    consider(dot(cross(f.x, f.y), f.z), 1);
    consider(length(f.z - z), 0);
    return worst;
}

std::vector<Vec3<double>> axes()
{
    std::vector<Vec3<double>> list{{0, 0, 1},
                                   {0, 0, -1},
                                   {1, 0, 0},
                                   {0, 1, 0},
                                   {0, -1, 0},
                                   normalized(Vec3<double>{1e-7, 0, -1}),
                                   normalized(Vec3<double>{1, 0, -1e-12})};
    Uniforms uniforms(1);
    for (int i = 0; i < 1000; ++i) list.push_back(uniforms.direction());
    return list;
}

TEST(Frame, IsOrthonormalAndRightHandedAroundEveryAxis)
{
    for (const Vec3<double>& z : axes()) {
        EXPECT_LT(error_of(frame_around(z), z), 2e-15) << z.x << " " << z.y << " " << z.z;
        const Vec3<float> zf = vec_cast<float>(z);
        EXPECT_LT(error_of(frame_around(zf), zf), 1e-6) << z.x << " " << z.y << " " << z.z;
    }
}

TEST(Frame, ToLocalUndoesToWorld)
{
    Uniforms uniforms(2);
    for (const Vec3<double>& z : axes()) {
        const Frame<double> frame = frame_around(z);
        const Vec3<double> v = uniforms.direction();
        EXPECT_LT(length(frame.to_local(frame.to_world(v)) - v), 1e-14);
    }
}

TEST(Frame, LanesAgreeWithOneAtATime)
{
    using V = TestLanes<float>;
    const auto list = axes();
    for (std::size_t first = 0; first + lane_count<V> <= list.size(); first += lane_count<V>) {
        const auto z = [&](std::size_t i) { return vec_cast<float>(list[first + i]); };
        const Frame<V> frames = frame_around(vec_lanes_from<V>(z));
        for (std::size_t i = 0; i < lane_count<V>; ++i)
            EXPECT_EQ(lane(frames.x, i), frame_around(z(i)).x);
    }
}

}  // namespace
}  // namespace mis
