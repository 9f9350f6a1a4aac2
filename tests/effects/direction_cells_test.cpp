#include "mis/effects/direction_cells.h"

#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

TEST(DirectionCells, EveryDirectionIsInTheConeOfItsCell)
{
    Uniforms uniforms(91);
    std::array<int, DirectionCells::count> seen{};
    for (int i = 0; i < 400'000; ++i) {
        Vec3<double> wi = uniforms.direction();
        if (i % 4 == 0) wi[i / 4 % 3] *= 1e-8;  // near a fold
        if (i % 16 == 1) wi = Vec3<double>(0), wi[i / 16 % 3] = i % 32 == 1 ? 1 : -1;
        wi = normalized(wi);
        const std::size_t cell = DirectionCells::of(vec_cast<float>(wi));
        ASSERT_LT(cell, DirectionCells::count);
        const DirectionCells::Cone& cone = DirectionCells::cones()[cell];
        ASSERT_LE(length(cross(cone.axis, wi)), cone.sine);
        ASSERT_GT(dot(cone.axis, wi), 0);
        ++seen[cell];
    }
    for (std::size_t cell = 0; cell < DirectionCells::count; ++cell) {
        EXPECT_GT(seen[cell], 0) << cell;
        EXPECT_LT(DirectionCells::cones()[cell].sine, 0.14) << cell;
    }
}

TEST(DirectionCells, WhatIsNoDirectionIsInSomeCell)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_LT(DirectionCells::of({0, 0, 0}), DirectionCells::count);
    EXPECT_LT(DirectionCells::of({nan, 0, 1}), DirectionCells::count);
}

}  // namespace
}  // namespace mis
