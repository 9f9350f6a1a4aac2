#include "mis/trace/surface_points.h"

#include "mis/math/stop_token.h"
#include "mis/sampling/random.h"
#include "mis/trace/intersect.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mis {
namespace {

/// Uniform in [0, 1): number k of a stream.
double uniform(std::uint64_t stream, std::uint32_t k)
{
    return unit_number<double>(random_words(5, {0, stream, k}, Block::light)[1]);
}

Vec3<double> somewhere(std::uint64_t stream, std::uint32_t k, double size)
{
    return Vec3<double>(uniform(stream, 3 * k), uniform(stream, 3 * k + 1),
                        uniform(stream, 3 * k + 2)) *
               (2 * size) -
           size;
}

/// Triangles of all sizes and shapes, from slivers and needles to ones that span the scene, with
/// some that have no area; and quads and spheres.
Scene many_surfaces(std::uint64_t seed)
{
    Scene scene;
    Mesh mesh;
    for (std::uint32_t t = 0; t < 400; ++t) {
        const double size = std::pow(10.0, -7 + 9 * uniform(seed, 4000 + t));
        const Vec3<double> a = somewhere(seed, 3 * t, 100);
        Vec3<double> e1 = somewhere(seed, 3 * t + 1, size), e2 = somewhere(seed, 3 * t + 2, size);
        if (t % 5 == 1) e2 = e1 * 0.7 + e2 * std::pow(10.0, -15 * uniform(seed, 5000 + t));
        if (t % 5 == 2) e1 *= std::pow(10.0, -12 * uniform(seed, 5000 + t));
        if (t % 50 == 3) e2 = e1;
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {a, a + e1, a + e2});
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    scene.surfaces.push_back({SphereSurface{{0, 0, 0}, 3}, 0});
    scene.surfaces.push_back({mesh, 0});
    for (std::uint32_t q = 0; q < 30; ++q)
        scene.surfaces.push_back(
            {Quad{somewhere(seed + 1, 3 * q, 100),
                  {somewhere(seed + 1, 3 * q + 1, 50), somewhere(seed + 1, 3 * q + 2, 50)}},
             0});
    return scene;
}

/// On the surfaces, at their corners and edges, just beside them, and anywhere.
std::vector<Vec3<double>> points_about(const Scene& scene, std::uint64_t seed)
{
    std::vector<Vec3<double>> points{{0, 0, 0}, {3, 0, 0}};
    const auto add = [&](const Vec3<double>& corner, const Vec3<double>& e1, const Vec3<double>& e2,
                         std::uint32_t k) {
        const double u = uniform(seed, 8 * k), v = (1 - u) * uniform(seed, 8 * k + 1);
        points.push_back(corner);
        points.push_back(corner + e1 * u + e2 * v);
        points.push_back(corner + e1 * u + e2 * (1 - u));
        points.push_back(corner + e1 * (1 + 1e-6 * uniform(seed, 8 * k + 2)));
        points.push_back(corner + e1 * u + e2 * v + somewhere(seed + 7, k, 1e-4));
        points.push_back(corner + e1 * (4 * u - 2) + e2 * (4 * v - 2));
    };
    std::uint32_t k = 0;
    const Mesh& mesh = std::get<Mesh>(scene.surfaces[1].shape);
    for (const auto& t : mesh.triangles)
        add(mesh.positions[t[0]], mesh.positions[t[1]] - mesh.positions[t[0]],
            mesh.positions[t[2]] - mesh.positions[t[0]], k++);
    for (const Surface& surface : scene.surfaces)
        if (const auto* quad = std::get_if<Quad>(&surface.shape))
            add(quad->corner, quad->edges[0], quad->edges[1], k++);
    for (std::uint32_t i = 0; i < 50; ++i) points.push_back(somewhere(seed + 9, i, 150));
    return points;
}

void one_by_one(std::size_t n, const std::function<void(std::size_t)>& body)
{
    for (std::size_t i = 0; i < n; ++i) body(i);
}

TEST(OffsetsOfPoints, AreThoseOfAWalkOverAllTrianglesForEachPoint)
{
    std::size_t on_a_surface = 0;
    for (const std::uint64_t seed : {1, 20, 300}) {
        const Scene scene = many_surfaces(seed);
        const std::vector<Vec3<double>> points = points_about(scene, seed);
        for (const Vec3<double>& origin : {Vec3<double>(0), Vec3<double>(1e3, -7, 2e5)}) {
            std::vector<double> offsets(points.size(), -1);
            offsets_of_points(scene, points, origin, one_by_one, offsets);
            for (std::size_t i = 0; i < points.size(); ++i) {
                ASSERT_EQ(offsets[i], offset_of_point(scene, points[i], origin)) << i;
                if (offsets[i] > float_offset(largest_coordinate(points[i] - origin)))
                    ++on_a_surface;
            }
        }
    }
    EXPECT_GT(on_a_surface, 1000U);  // or nothing was looked for
}

/// A square of many triangles, and points all over it: a walk for each point would come to the
/// product of both. The parts are what is shared out; a point adds none.
TEST(OffsetsOfPoints, PassOverTheTrianglesOnceForAllPoints)
{
    Scene scene;
    Mesh mesh;
    constexpr std::uint32_t side = 150;
    for (std::uint32_t j = 0; j <= side; ++j)
        for (std::uint32_t i = 0; i <= side; ++i) mesh.positions.push_back({0.1 * i, 0.1 * j, 0});
    for (std::uint32_t j = 0; j < side; ++j)
        for (std::uint32_t i = 0; i < side; ++i) {
            const std::uint32_t a = j * (side + 1) + i, b = a + side + 1;
            mesh.triangles.push_back({a, a + 1, b + 1});
            mesh.triangles.push_back({a, b + 1, b});
        }
    scene.surfaces.push_back({mesh, 0});
    const auto parts_for = [&](std::size_t count) {
        std::vector<Vec3<double>> points;
        for (std::uint32_t k = 0; k < count; ++k)
            points.push_back({15 * uniform(3, 2 * k), 15 * uniform(3, 2 * k + 1), 0});
        std::vector<double> offsets(count);
        std::size_t parts = 0;
        offsets_of_points(
            scene, points, Vec3<double>(0),
            [&](std::size_t n, const auto& body) { parts = n, one_by_one(n, body); }, offsets);
        return parts;
    };
    EXPECT_EQ(parts_for(1), parts_for(1000));
    EXPECT_GT(parts_for(1), 1U);
}

TEST(OffsetsOfPoints, EndWhereTheirExecutorIsStopped)
{
    const Scene scene = many_surfaces(1);
    const std::vector<Vec3<double>> points(10);
    std::vector<double> offsets(points.size());
    const ForEach stopped = [](std::size_t, const auto&) { throw Stopped(); };
    EXPECT_THROW(offsets_of_points(scene, points, Vec3<double>(0), stopped, offsets), Stopped);
}

}  // namespace
}  // namespace mis
