// Bar 6: bytes per light and per shading point, and how soon a million lights are ready.
#include "bench/random_scene.h"
#include "bench/ready.h"
#include "bench/subjects.h"
#include "mis/engine/choices.h"
#include "mis/engine/stopwatch.h"
#include "mis/io/scene_json.h"
#include "mis/policy/light_tree.h"

#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace mis::bench {

namespace {

constexpr std::size_t million = 1'000'000;

/// Bytes that the heap has handed out.
double heap_bytes()
{
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

/// What a value that `make` returns keeps on the heap, per light; to a hundredth of a byte, which
/// leaves out the heap's own headers.
template <class Make> double bytes_per_light(const Make& make)
{
    const double before = heap_bytes();
    const auto kept = make();
    benchmark::DoNotOptimize(kept);
    return std::round(100 * (heap_bytes() - before) / static_cast<double>(million)) / 100;
}

void measure_memory(benchmark::State& state)
{
    for (auto _ : state) {
        const Scene scene = random_scene(million);
        const Lights& lights = scene.lights;
        state.counters["light"] = bytes_per_light([&] { return Lights(lights); });
        state.counters["hierarchy"] = bytes_per_light([&] { return LightHierarchy(lights); });
        for (const PolicyStages<float>& policy : kernels<float>().policies) {
            const double kept = bytes_per_light([&] { return make_policy(policy.name, lights); });
            state.counters["kept_" + std::string(policy.name)] = kept;
        }
        state.counters["point"] = sizeof(ShadingPoint);
        state.counters["moments"] = sizeof(PointResult);
    }
}

/// A folder that goes when it is done with.
struct Folder {
    Folder() : path(std::filesystem::temp_directory_path() / fmt::format("mis-bench-{}", getpid()))
    {
        std::filesystem::create_directories(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::filesystem::path path;
};

/// A scene file of a million lights: an entry of type "random", or a table of them.
std::filesystem::path write_scene(const Folder& folder, bool is_table)
{
    const std::filesystem::path file = folder.path / (is_table ? "table.json" : "random.json");
    std::string lights = fmt::format(
        R"({{"type":"random","count":{},"seed":1,"box":[[-18,4,-18],[18,8,18]],"radius":[6e-4,6e-3],"power":[1,100]}})",
        million);
    if (is_table) {
        std::ofstream table(folder.path / "lights.csv");
        table << "x,y,z,radius,r,g,b\n";
        for (const Light& light : random_scene(million).lights)
            table << fmt::format("{:.6g},{:.6g},{:.6g},{:.6g},1,1,1\n", light.center.x,
                                 light.center.y, light.center.z, light.radius);
        lights = R"({"type":"table","file":"lights.csv"})";
    }
    std::ofstream(file)
        << R"({"format":"mis-scene/1","camera":{"position":[0,8,22],"target":[0,1,0],"up":[0,1,0],"vertical_fov":45,"resolution":[64,64]},)"
        << R"("materials":{"m":{"type":"lambert","albedo":0.5}},"surfaces":[{"type":"quad","corner":[-20,0,-20],"edges":[[0,0,40],[40,0,0]],"material":"m"}],)"
        << R"("lights":[)" << lights << "]}";
    return file;
}

/// From a file to a strategy that is ready to draw.
void start(benchmark::State& state, const std::filesystem::path& file)
{
    double seconds = 0;
    for (auto _ : state) {
        const auto from = std::chrono::steady_clock::now();
        const double cpu = thread_seconds();
        const Ready ready(read_scene(file), Effect::called_for);
        const ReadyStrategy<float> strategy(ready.lit, parse_strategy("power/power"),
                                            kernels<float>(), 1);
        benchmark::DoNotOptimize(strategy.strategy());
        seconds = thread_seconds() - cpu;
        state.counters["wall_seconds"] =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
    }
    state.counters["seconds"] = seconds;
}

/// The hierarchy of `tree`.
void build_tree(benchmark::State& state, const Lights& lights)
{
    double seconds = 0;
    for (auto _ : state) {
        const auto from = std::chrono::steady_clock::now();
        const LightTree tree(lights);
        benchmark::DoNotOptimize(tree.bytes());
        seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count();
    }
    state.counters["seconds"] = seconds;
}

}  // namespace

void add_memory()
{
    const auto lights = lazily<Lights>([] { return new Lights(random_scene(million).lights); });
    benchmark::RegisterBenchmark("start/tree", [=](benchmark::State& state) {
        build_tree(state, lights());
    })->Iterations(1);
    benchmark::RegisterBenchmark("memory", measure_memory)->Iterations(1)->Repetitions(1);
    const auto folder = lazily<Folder>([] { return new Folder; });
    for (const bool is_table : {false, true}) {
        const auto file = lazily<std::filesystem::path>(
            [=] { return new std::filesystem::path(write_scene(folder(), is_table)); });
        benchmark::RegisterBenchmark(is_table ? "start/table" : "start/random",
                                     [=](benchmark::State& state) { start(state, file()); })
            ->Iterations(1);
    }
}

Bars memory_bars(const Figures& figures)
{
    const auto bytes = [&](const std::string& counter) { return figures.at("memory", counter); };
    Bars bars{{6, "bytes per light, data", bytes("light"), Bar::Sense::at_most, 40},
              {6, "bytes per light, hierarchy", bytes("hierarchy"), Bar::Sense::at_most, 32}};
    for (const PolicyStages<float>& policy : kernels<float>().policies)
        bars.push_back({6, "bytes per light, table of " + std::string(policy.name),
                        bytes("kept_" + std::string(policy.name)), Bar::Sense::at_most,
                        policy.name == "tree" ? 64.0 : 12.0});
    bars.push_back({6, "bytes per shading point", bytes("point"), Bar::Sense::at_most, 64});
    bars.push_back(
        {6, "bytes per shading point, moments and radiance", bytes("moments"), Bar::Sense::report});
    bars.push_back({6, "seconds to start, 10^6 random lights",
                    figures.at("start/random", "seconds"), Bar::Sense::at_most, 1});
    bars.push_back({6, "seconds to start, 10^6 lights in a table",
                    figures.at("start/table", "seconds"), Bar::Sense::at_most, 1});
    bars.push_back({6, "seconds by the wall to build tree, 10^6 lights",
                    figures.at("start/tree", "seconds"), Bar::Sense::at_most, 1.5});
    return bars;
}

}  // namespace mis::bench
