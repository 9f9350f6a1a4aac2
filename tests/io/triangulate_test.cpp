#include "mis/io/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace mis {
namespace {

using Polygon = std::vector<Vec3<double>>;

/// Twice the area within a plane outline that does not cross itself, by the shoelace formula.
double outline_area(const Polygon& polygon)
{
    Vec3<double> sum(0);
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return length(sum);
}

/// Whether the triangles are turned as the outline is and have its area: then they cover it once.
testing::AssertionResult is_covered_once(const Polygon& polygon)
{
    std::vector<PolygonTriangle> triangles;
    if (!triangulate(polygon, triangles)) return testing::AssertionFailure() << "was refused";
    Vec3<double> normal(0);
    for (std::size_t i = 0; i < polygon.size(); ++i)
        normal += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    double area = 0;
    for (const auto& [a, b, c] : triangles) {
        const Vec3<double> part = cross(polygon[b] - polygon[a], polygon[c] - polygon[a]);
        if (!(dot(part, normal) > 0))
            return testing::AssertionFailure()
                   << "triangle " << a << ", " << b << ", " << c << " is turned over or empty";
        area += length(part);
    }
    const double expected = outline_area(polygon);
    if (std::abs(area - expected) <= 1e-9 * expected) return testing::AssertionSuccess();
    return testing::AssertionFailure() << "area " << area << " of " << expected;
}

/// The corners of a plane outline, turned out of all planes of the axes and moved.
Polygon tilted(const std::vector<std::array<double, 2>>& outline)
{
    const Vec3<double> u{0.36, 0.48, -0.8}, v{-0.8, 0.6, 0}, origin{3, -7, 11};
    Polygon polygon;
    for (const auto& [x, y] : outline) polygon.push_back(origin + x * u + y * v);
    return polygon;
}

Polygon upright(const std::vector<std::array<double, 2>>& outline)
{
    Polygon polygon;
    for (const auto& [x, y] : outline) polygon.push_back({x, 0.25, y});
    return polygon;
}

/// All ways to write the same outline: each corner first, and from behind.
void expect_covered_once(std::vector<std::array<double, 2>> outline)
{
    for (int side = 0; side < 2; ++side) {
        for (std::size_t turn = 0; turn < outline.size(); ++turn) {
            EXPECT_TRUE(is_covered_once(upright(outline))) << "from corner " << turn;
            EXPECT_TRUE(is_covered_once(tilted(outline))) << "tilted, from corner " << turn;
            std::rotate(outline.begin(), outline.begin() + 1, outline.end());
        }
        std::reverse(outline.begin(), outline.end());
    }
}

TEST(Triangulate, CoversPolygonsOnce)
{
    expect_covered_once({{0, 0}, {1, 0}, {0, 1}});
    expect_covered_once({{0, 0}, {2, 0}, {2, 1}, {0, 1}});
    expect_covered_once({{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}});  // an arrow
    expect_covered_once({{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});  // a U
    expect_covered_once({{0, 0},
                         {6, 0},
                         {6, 6},
                         {1, 6},
                         {1, 2},
                         {4, 2},
                         {4, 4},
                         {3, 4},
                         {3, 3},
                         {2, 3},
                         {2, 5},
                         {5, 5},
                         {5, 1},
                         {0, 1}});  // a spiral
}

TEST(Triangulate, CopesWithCornersOnALineAndRepeatedOnes)
{
    expect_covered_once({{0, 0}, {0.1, 0}, {0.3, 0}, {1, 0}, {1, 0.7}, {1, 1}, {0.5, 1}, {0, 1}});
    expect_covered_once({{0, 0}, {1, 0}, {2, 0}, {0, 1}});
    expect_covered_once({{0, 0}, {0.1, 0.1}, {0.2, 0.2}, {0.3, 0.3}, {0.7, 0.7}, {0, 1}});
    expect_covered_once({{0, 0}, {0, 0}, {1, 0}, {1, 1}, {1, 1}, {1, 1}, {0, 1}});
    expect_covered_once({{0, 0}, {1, 0}, {1, 0}, {0, 1}});
    expect_covered_once({{0, 0}, {2, 0}, {2, 1}, {3, 1}, {2, 1}, {2, 2}, {0, 2}});  // a spike
}

TEST(Triangulate, ReachesHolesByBridges)
{
    expect_covered_once(
        {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}});
    expect_covered_once({{0, 0},
                         {9, 0},
                         {9, 4},
                         {0, 4},
                         {0, 0},
                         {1, 1},
                         {1, 3},
                         {3, 3},
                         {3, 1},
                         {5, 1},
                         {5, 3},
                         {7, 3},
                         {7, 1},
                         {5, 1},
                         {3, 1},
                         {1, 1}});
    expect_covered_once({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {1, 2}, {2, 1}, {3, 2}, {2, 4}, {0, 4}});
}

/// Around a centre, each corner at a random distance: as a rule neither convex nor alike.
TEST(Triangulate, CoversRandomStarsOnce)
{
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> distance(0.1, 1);
    for (int round = 0; round < 300; ++round) {
        std::vector<std::array<double, 2>> outline;
        const int corners = 5 + round % 40;
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * std::numbers::pi * i / corners, r = distance(random);
            outline.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
        ASSERT_TRUE(is_covered_once(tilted(outline))) << "round " << round;
        std::reverse(outline.begin(), outline.end());
        ASSERT_TRUE(is_covered_once(upright(outline))) << "round " << round;
    }
}

TEST(Triangulate, CoversAPolygonOfManyCornersSoon)
{
    std::vector<std::array<double, 2>> comb;
    constexpr int teeth = 2000;
    for (int i = 0; i < teeth; ++i) {
        comb.push_back({double(i), i % 3 == 0 ? 2.0 : 1.0});
        comb.push_back({i + 0.5, 0.1});
    }
    comb.push_back({teeth - 0.5, -1});
    comb.push_back({0, -1});
    EXPECT_TRUE(is_covered_once(upright(comb)));
}

TEST(Triangulate, CutsASkewQuadAlongItsFirstDiagonal)
{
    std::vector<PolygonTriangle> triangles;
    const Polygon skew{{0, 0, 0}, {1, 0, 0.4}, {1, 1, 0}, {0, 1, 0.4}};
    ASSERT_TRUE(triangulate(skew, triangles));
    EXPECT_EQ(triangles, (std::vector<PolygonTriangle>{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, GivesNothingForWhatHasNoArea)
{
    std::vector<PolygonTriangle> triangles;
    EXPECT_TRUE(triangulate(Polygon(4, {1, 2, 3}), triangles));
    EXPECT_TRUE(triangles.empty());
    EXPECT_TRUE(triangulate(tilted({{0, 0}, {0.1, 0.3}, {0.2, 0.6}, {0.7, 2.1}}), triangles));
    EXPECT_TRUE(triangles.empty());
}

TEST(Triangulate, RefusesWhatCrossesItself)
{
    std::vector<PolygonTriangle> triangles;
    const std::vector<std::vector<std::array<double, 2>>> crossing{
        {{0, 0}, {1, 1}, {1, 0}, {0, 1}},
        {{0, 0}, {3, 3}, {3, 0}, {0, 1}},
        {{0, 0}, {4, 0}, {4, 4}, {2, -1}, {0, 4}},
        {{0, 1}, {0.6, -0.8}, {-0.95, 0.3}, {0.95, 0.3}, {-0.6, -0.8}}};  // a pentagram
    for (const auto& outline : crossing) {
        EXPECT_FALSE(triangulate(upright(outline), triangles));
        EXPECT_FALSE(triangulate(tilted(outline), triangles));
    }
}

/// A sphere of quads in single precision: the sine of its π is below 0, so the last ring is turned
/// over, by 1e-7.
TEST(Triangulate, TakesWhatCrossesWithinSixDigitsForTouching)
{
    std::vector<PolygonTriangle> triangles;
    const auto ring = [](float theta, float phi) {
        return Vec3<double>{double(std::sin(theta) * std::cos(phi)),
                            double(std::sin(theta) * std::sin(phi)), double(std::cos(theta))};
    };
    const float pi = 3.14159274f;
    const Polygon quad{ring(3.0f, 0.1f), ring(3.0f, 0.2f), ring(pi, 0.2f), ring(pi, 0.1f)};
    ASSERT_TRUE(triangulate(quad, triangles));
    ASSERT_EQ(triangles.size(), 1u);
    Polygon many = quad;
    many.insert(many.begin() + 1, ring(3.0f, 0.15f));
    ASSERT_TRUE(triangulate(many, triangles));
    ASSERT_GE(triangles.size(), 1u);
    EXPECT_TRUE(triangulate(
        Polygon{{0.1f, 0.2f, 0.3f}, {0.3f, 0.6f, 0.9f}, {0.2f, 0.4f, 0.6f}, {0.7f, 1.4f, 2.1f}},
        triangles));
    EXPECT_TRUE(triangles.empty());
}

TEST(Triangulate, StopsWhenToldTo)
{
    std::vector<std::array<double, 2>> outline;
    for (int i = 0; i < 1000; ++i) outline.push_back({std::cos(i * 0.006), std::sin(i * 0.006)});
    const std::function<bool()> asked = [] { return true; };
    std::vector<PolygonTriangle> triangles;
    EXPECT_THROW(triangulate(upright(outline), triangles, StopToken(&asked)), Stopped);
}

}  // namespace
}  // namespace mis
