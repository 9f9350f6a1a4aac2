// A stranger's renderer (tests/embed/host) against mis's own, on one scene that each reads in its
// own format: the same points are lit, and as bright.
#include "mis/engine/render.h"
#include "mis/io/scene_json.h"
#include "mis/run/serial.h"
#include "mis/strategy/strategy.h"
#include "mis/trace/embree.h"

#include "tests/embed/host/after/integrator.h"
#include "tests/support/places.h"

#include <gtest/gtest.h>
#include <boost/math/distributions/students_t.hpp>

#include <fstream>

namespace {

using mis::Moments;

const std::filesystem::path folder = mis::source_dir() / "tests/embed/host";

host::Scene host_scene()
{
    std::ifstream text(folder / "room.scene");
    return host::read_scene(text);
}

/// Direct light of every pixel, row by row; black where the camera sees no surface.
using Picture = std::vector<mis::Vec3<double>>;

/// One picture of `samples` samples; direct_light(vertex, random): one of them.
Picture picture_by(const host::Scene& scene, const auto& direct_light, int samples, int seed)
{
    Picture picture;
    for (int row = 0; row < scene.camera.height; ++row)
        for (int column = 0; column < scene.camera.width; ++column) {
            host::Random random(static_cast<std::uint64_t>(seed), picture.size());
            picture.push_back({0, 0, 0});
            host::Ray ray = scene.camera.ray(column, row);
            const int primitive = scene.surfaces.nearest(ray);
            if (scene.nearest_light(ray) != nullptr || primitive < 0) continue;
            const host::Vertex vertex = scene.vertex(ray, primitive);
            for (int k = 0; k < samples; ++k) {
                const host::Vec v = direct_light(vertex, random);
                picture.back() += mis::Vec3<double>(v.x, v.y, v.z) / double(samples);
            }
        }
    return picture;
}

/// The scene as `mis render` has it.
struct Ours {
    mis::Scene scene = mis::read_scene(folder / "room.json");
    mis::EmbreeTracer tracer{scene};
    mis::LitScene lit{scene, &tracer, mis::called_for(scene)};
    mis::AnyExecutor serial = mis::any_executor(mis::SerialExecutor{});
    mis::Band unlit = mis::find_band(lit, 0, scene.camera->resolution[1], serial);
    mis::ReadyStrategy<float> strategy{
        lit, mis::parse_strategy("irradiance/power"), mis::kernels<float>(), {1, 0}};
    mis::WorkspacePool<float> workspaces;

    Picture picture(int samples, int number)
    {
        mis::Band band = unlit;
        const auto first = static_cast<std::uint64_t>(number) * static_cast<std::uint64_t>(samples);
        mis::light_band(strategy, band, first, samples, workspaces, serial);
        const auto [width, height] = scene.camera->resolution;
        Picture picture(static_cast<std::size_t>(width * height), {0, 0, 0});
        for (std::size_t p = 0; p < band.results.size(); ++p)
            picture[band.shading.points[p].id] = band.results[p].mean();
        return picture;
    }
};

constexpr int width = 60, side = 10;                // pixels: of a picture, of a square of it
constexpr int pictures = 64, samples_of_each = 12;  // independent of one another

/// Per square and channel, and last of the whole, the means of many pictures. make(number): one.
std::vector<std::array<Moments, 3>> squares_of(const auto& make)
{
    std::vector<std::array<Moments, 3>> squares(25);
    for (int number = 0; number < pictures; ++number) {
        std::vector<mis::Vec3<double>> sums(squares.size(), {0, 0, 0});
        const Picture picture = make(number);
        for (std::size_t i = 0; i < picture.size(); ++i) {
            const std::size_t column = i % width / side, row = i / width / side;
            sums.at(row * (width / side) + column) += picture[i];
            sums.back() += picture[i] / 24.0;
        }
        for (std::size_t s = 0; s < sums.size(); ++s)
            for (int c = 0; c < 3; ++c)
                squares[s][static_cast<std::size_t>(c)].add(sums[s][c] / (side * side));
    }
    return squares;
}

/// Welch's test that two means are one.
double p_value(const Moments& a, const Moments& b)
{
    const double va = mis::square(a.mean_se()), vb = mis::square(b.mean_se());
    if (va + vb == 0) return a.mean == b.mean ? 1 : 0;
    const double n = static_cast<double>(a.count) - 1, m = static_cast<double>(b.count) - 1;
    const double freedom = mis::square(va + vb) / (va * va / n + vb * vb / m);
    const double t = std::abs(a.mean - b.mean) / std::sqrt(va + vb);
    return 2 * cdf(complement(boost::math::students_t(freedom), t));
}

/// The least p-value over all squares and channels, Bonferroni's correction in it.
double p_value(const std::vector<std::array<Moments, 3>>& a,
               const std::vector<std::array<Moments, 3>>& b)
{
    double least = 1;
    for (std::size_t s = 0; s < a.size(); ++s)
        for (std::size_t c = 0; c < 3; ++c) least = std::min(least, p_value(a[s][c], b[s][c]));
    return std::min(1.0, 3 * static_cast<double>(a.size()) * least);
}

double variance_of(const std::vector<std::array<Moments, 3>>& squares)
{
    double sum = 0;
    for (const auto& square : squares)
        for (const Moments& channel : square) sum += channel.variance();
    return sum;
}

TEST(Host, SeesThePointsThatMisSees)
{
    const host::Scene scene = host_scene();
    Ours ours;
    ASSERT_EQ(scene.camera.width, width);
    std::size_t seen = 0;
    for (int row = 0; row < scene.camera.height; ++row)
        for (int column = 0; column < width; ++column) {
            host::Ray ray = scene.camera.ray(column, row);
            const int primitive = scene.surfaces.nearest(ray);
            if (scene.nearest_light(ray) == nullptr && primitive >= 0) ++seen;
        }
    const mis::GBuffer& buffer = ours.unlit.shading;
    EXPECT_EQ(seen, buffer.points.size() + buffer.dark.size());
    for (const mis::ShadingPoint& point : buffer.points) {
        const int id = static_cast<int>(point.id);
        host::Ray ray = scene.camera.ray(id % width, id / width);
        const int primitive = scene.surfaces.nearest(ray);
        ASSERT_GE(primitive, 0);
        const host::Vertex at = scene.vertex(ray, primitive);
        EXPECT_LT(length(mis::Vec3<double>(at.x.x, at.x.y, at.x.z) - point.x), 1e-4);
        EXPECT_GT(dot(host::to_mis(at.n()), point.n), 0.9999F);
    }
}

TEST(Host, IsLitAsMisRendersIt)
{
    constexpr double false_alarm = 1e-6;  // per comparison, once: the seeds are fixed
    const host::Scene scene = host_scene();
    host::Integrator with_mis(scene);
    const auto by_mis = [&](const host::Vertex& at, host::Random& random) {
        return with_mis.direct_light(at, random);
    };
    const auto by_itself = [&](const host::Vertex& at, host::Random& random) {
        return host::sample_one_light(scene, at, random);
    };
    Ours ours;
    const auto reference = squares_of([&](int k) { return ours.picture(samples_of_each, k); });
    const auto before =
        squares_of([&](int k) { return picture_by(scene, by_itself, samples_of_each, k); });
    const auto after =
        squares_of([&](int k) { return picture_by(scene, by_mis, samples_of_each, k); });
    EXPECT_GT(p_value(reference, after), false_alarm);
    EXPECT_GT(p_value(reference, before), false_alarm);
    EXPECT_LT(variance_of(after), 0.1 * variance_of(before));  // what the host gains

    // The twin: 2 % more of the channel red is seen.
    auto redder = after;
    for (auto& square : redder) square[0].mean *= 1.02;
    EXPECT_LT(p_value(reference, redder), false_alarm);
}

}  // namespace
