#include "mis/effects/tile_parts.h"

#include "tests/support/uniforms.h"

#include <gtest/gtest.h>

namespace mis {
namespace {

std::vector<ShadingPoint> strip(int count, double length, Uniforms& uniforms)
{
    std::vector<ShadingPoint> points(static_cast<std::size_t>(count));
    for (ShadingPoint& p : points) p.x = {1e3 + uniforms(), 0, uniforms.between(0, length)};
    return points;
}

TEST(TileParts, HoldEveryPoint)
{
    Uniforms uniforms(95);
    for (const int count : {1, 2, 7, 256}) {
        const std::vector<ShadingPoint> points = strip(count, 30, uniforms);
        const TileParts parts(points);
        EXPECT_LE(parts.balls().size(), std::min<std::size_t>(TileParts::most, points.size()));
        for (std::size_t guess = 0; guess <= parts.balls().size(); ++guess)
            for (const ShadingPoint& p : points) {
                const std::size_t k = parts.holding(p.x, guess);
                ASSERT_LT(k, parts.balls().size());
                EXPECT_LE(length(p.x - parts.balls()[k].center), parts.balls()[k].radius);
                EXPECT_LE(length(p.x - parts.around().center), parts.around().radius);
            }
        EXPECT_EQ(parts.holding({0, 0, 0}, 0), parts.balls().size());
    }
}

TEST(TileParts, OfALongStripAreSmall)
{
    Uniforms uniforms(96);
    const TileParts parts(strip(256, 30, uniforms));
    EXPECT_EQ(parts.balls().size(), TileParts::most);
    for (const BoundingBall& ball : parts.balls())
        EXPECT_LT(ball.radius, parts.around().radius / 10);
}

TEST(TileParts, OfPointsInOnePlaceIsOne)
{
    const std::vector<ShadingPoint> points(9, ShadingPoint{.x = {1, 2, 3}});
    const TileParts parts(points);
    EXPECT_EQ(parts.balls().size(), 1U);
    EXPECT_EQ(parts.holding({1, 2, 3}, 0), 0U);
}

}  // namespace
}  // namespace mis
