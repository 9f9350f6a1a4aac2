// What a stranger's renderer pays for mis: the direct light of tests/embed/host, with its own
// virtual BSDFs, random numbers and rays, over the engine's own scalar loop (engine/direct.h) with
// the engine's BSDFs, numbers and Embree, at the same points of the same scene. One sample each
// time a point is moved to, as in a path tracer. Both run in small alternating rounds; `ratio` is
// the median of theirs. The bar is 1.3. And what many points in one call cost over that loop.
#include "mis/bsdf/framed.h"
#include "mis/engine/render.h"
#include "mis/io/scene_json.h"
#include "mis/mis.h"
#include "mis/run/serial.h"
#include "mis/sampling/random.h"
#include "mis/trace/embree.h"

#include "tests/embed/host/after/integrator.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <type_traits>
#include <variant>
#include <vector>

namespace {

using namespace mis;  // NOLINT: a program of its own
using Policy = IrradiancePolicy;

const std::filesystem::path folder = std::filesystem::path(MIS_SOURCE_DIR) / "tests/embed/host";

/// The engine's scalar loop. `with_rays`: surfaces occlude.
class Engine {
public:
    Engine() : tracer_(scene_), lit_(scene_, &tracer_, called_for(scene_)) {}

    const LitScene& lit() const { return lit_; }
    GBuffer points() const
    {
        return find_shading_points(scene_, lit_.lights(), &tracer_, 0, scene_.camera->resolution[1],
                                   any_executor(SerialExecutor{}));
    }
    Vec3<float> direct_light(const ShadingPoint& at, int material, std::uint64_t sample,
                             bool with_rays, bool is_new = true)
    {
        const auto numbers = [&](int draw) -> DirectNumbers<float> {
            const Counter counter{at.id, sample, static_cast<std::uint32_t>(draw)};
            const Words light = random_words(1, counter, Block::light),
                        bsdf = random_words(1, counter, Block::bsdf);
            const auto u = [](std::uint32_t word) { return unit_number<float>(word); };
            return {choice_bits(light),
                    {u(light[2]), u(light[3])},
                    u(bsdf[1]),
                    {u(bsdf[2]), u(bsdf[3])}};
        };
        const auto is_occluded = [&](const Vec3<float>& wi, float distance) {
            if (!with_rays) return false;
            const ShadowRay ray{at.ray_origin, wi, distance};
            std::uint8_t hidden = 0;
            tracer_.occluded({&ray, 1}, {&hidden, 1});
            return hidden != 0;
        };
        if (is_new) point_.move_to(at.x, at.n);
        return std::visit(
            [&](const auto& bsdf) {
                const FramedBsdf<std::decay_t<decltype(bsdf)>, float> framed(bsdf, at.n, at.wo);
                return sample_direct<PowerHeuristic, ConeTechnique>(point_, framed, is_occluded,
                                                                    numbers)
                    .radiance;
            },
            bsdfs_[static_cast<std::size_t>(material)]);
    }

private:
    using AnyOfTwo = std::variant<Lambert, Blinn>;
    static std::vector<AnyOfTwo> bsdfs_of(const Scene& scene)
    {
        std::vector<AnyOfTwo> bsdfs;
        for (const Material& m : scene.materials)
            bsdfs.push_back(m.type == "blinn" ? AnyOfTwo(Blinn(m)) : Lambert(m));
        return bsdfs;
    }

    Scene scene_ = read_scene(folder / "room.json");
    EmbreeTracer tracer_;
    LitScene lit_;
    DirectLights<Policy> lights_{scene_.lights};
    DirectPoint<Policy> point_{lights_};
    std::vector<AnyOfTwo> bsdfs_ = bsdfs_of(scene_);
};

/// The host's points in the order of the engine's.
std::vector<host::Vertex> vertices_of(const host::Scene& scene, const GBuffer& points)
{
    std::vector<host::Vertex> vertices;
    for (const ShadingPoint& point : points.points) {
        const int id = static_cast<int>(point.id), width = scene.camera.width;
        host::Ray ray = scene.camera.ray(id % width, id / width);
        const int primitive = scene.surfaces.nearest(ray);
        vertices.push_back(scene.vertex(ray, primitive));
    }
    return vertices;
}

/// The engine's points as a host's arrays.
class Arrays {
public:
    Arrays(const GBuffer& buffer, const Vec3<double>& frame)
    {
        for (const Tile& tile : buffer.tiles)
            for (std::uint32_t p = tile.first; p < tile.first + tile.count; ++p) {
                const ShadingPoint& point = buffer.points[p];
                for (int c = 0; c < 3; ++c) {
                    const auto i = static_cast<std::size_t>(c);
                    x_[i].push_back(point.x[c]);
                    origin_[i].push_back(static_cast<double>(point.ray_origin[c]) + frame[c]);
                    n_[i].push_back(point.n[c]), wo_[i].push_back(point.wo[c]);
                    radiance_[i].push_back(0);
                }
                material_.push_back(tile.material), id_.push_back(point.id);
            }
    }
    PointArrays points() const
    {
        return {{x_[0], x_[1], x_[2]},
                {n_[0], n_[1], n_[2]},
                {wo_[0], wo_[1], wo_[2]},
                {origin_[0], origin_[1], origin_[2]},
                material_,
                id_};
    }
    RadianceArrays radiance() { return {radiance_[0], radiance_[1], radiance_[2]}; }

private:
    std::array<std::vector<double>, 3> x_, origin_;
    std::array<std::vector<float>, 3> n_, wo_, radiance_;
    std::vector<std::int32_t> material_;
    std::vector<std::uint32_t> id_;
};

double seconds_of(const auto& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> numbers)
{
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

host::Scene host_scene()
{
    std::ifstream text(folder / "room.scene");
    return host::read_scene(text);
}

/// One sample of every point by each, over and over.
void host_over_engine(benchmark::State& state, bool with_rays)
{
    Engine engine;
    const GBuffer points = engine.points();
    const host::Scene scene = host_scene();
    host::Scene lights_alone = host_scene();
    lights_alone.surfaces = host::Bvh({});
    host::Integrator integrator(with_rays ? scene : lights_alone);
    const std::vector<host::Vertex> vertices = vertices_of(scene, points);
    host::Random random(1);
    std::vector<double> of_host, of_engine, ratios;
    std::uint64_t sample = 0;
    for (auto _ : state) {
        of_host.push_back(seconds_of([&] {
            for (const host::Vertex& vertex : vertices)
                benchmark::DoNotOptimize(integrator.direct_light(vertex, random));
        }));
        of_engine.push_back(seconds_of([&] {
            for (const Tile& tile : points.tiles)
                for (std::uint32_t p = tile.first; p < tile.first + tile.count; ++p)
                    benchmark::DoNotOptimize(
                        engine.direct_light(points.points[p], tile.material, sample, with_rays));
        }));
        ratios.push_back(of_host.back() / of_engine.back());
        ++sample;
    }
    const double ns = 1e9 / static_cast<double>(vertices.size());
    state.counters["host_ns"] = ns * median(of_host);
    state.counters["engine_ns"] = ns * median(of_engine);
    state.counters["ratio"] = median(ratios);
}
/// Many points in one call (engine/light_points.h) over the scalar loop, `samples` of every point;
/// the scalar loop moves to a point once for all of them.
void many_over_engine(benchmark::State& state, int samples)
{
    Engine engine;
    const GBuffer points = engine.points();
    const ReadyStrategy<float> strategy(engine.lit(), parse_strategy("irradiance/power"),
                                        kernels<float>(), 1);
    PointLighter lighter(engine.lit(), strategy);
    Arrays arrays(points, engine.lit().surfaces()->origin());
    std::vector<double> of_many, of_engine, ratios;
    std::uint64_t sample = 0;
    for (auto _ : state) {
        of_many.push_back(seconds_of(
            [&] { lighter.light(arrays.points(), sample, samples, arrays.radiance()); }));
        of_engine.push_back(seconds_of([&] {
            for (const Tile& tile : points.tiles)
                for (std::uint32_t p = tile.first; p < tile.first + tile.count; ++p)
                    for (int k = 0; k < samples; ++k)
                        benchmark::DoNotOptimize(engine.direct_light(
                            points.points[p], tile.material, sample, true, k == 0));
        }));
        ratios.push_back(of_many.back() / of_engine.back());
        sample += static_cast<std::uint64_t>(samples);
    }
    const double ns = 1e9 / static_cast<double>(points.points.size()) / samples;
    state.counters["many_ns"] = ns * median(of_many);
    state.counters["engine_ns"] = ns * median(of_engine);
    state.counters["ratio"] = median(ratios);
}
BENCHMARK_CAPTURE(many_over_engine, 1_sample, 1)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(many_over_engine, 16_samples, 16)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(host_over_engine, with_rays, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(host_over_engine, without_rays, false)->Unit(benchmark::kMillisecond);

}  // namespace
