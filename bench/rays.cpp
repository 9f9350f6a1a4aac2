// Bar 2: a sample with rays, against what bare Embree takes for the same rays.
#include "bench/bare_embree.h"
#include "bench/recording.h"
#include "bench/subjects.h"
#include "mis/engine/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace mis::bench {

namespace {

const std::vector<std::string> scenes{"street", "hundred"};
const std::vector<std::string> strategies{"uniform/power", "power/power", "solid-angle/power",
                                          "radiant-solid-angle/power"};

std::string whole(const std::string& scene, const std::string& strategy)
{
    return "with_rays/" + scene + "/" + strategy;
}
std::string replay(const std::string& scene, const std::string& strategy, std::string_view call)
{
    return "replay/" + scene + "/" + strategy + "/" + std::string(call);
}

/// Rays of a strategy, and Embree alone.
struct Replay {
    Replay(const Ready& ready, const std::string& strategy)
        : recording(ready, strategy), embree(ready.scene)
    {
    }
    Recording recording;
    BareEmbree embree;
};

/// Of every batch of the engine, the rays by octant and then by azimuth: would that pay?
std::vector<ShadowRay> grouped(std::vector<ShadowRay> rays)
{
    constexpr std::size_t batch = 256;
    const auto key = [](const ShadowRay& ray) {
        const Vec3<float>& d = ray.direction;
        const int octant = (d.x < 0 ? 1 : 0) + (d.y < 0 ? 2 : 0) + (d.z < 0 ? 4 : 0);
        return std::pair{octant, std::atan2(d.z, d.x)};
    };
    for (std::size_t first = 0; first < rays.size(); first += batch) {
        const auto begin = rays.begin() + static_cast<std::ptrdiff_t>(first);
        const auto end = rays.size() - first > batch ? begin + batch : rays.end();
        std::sort(begin, end,
                  [&](const ShadowRay& a, const ShadowRay& b) { return key(a) < key(b); });
    }
    return rays;
}
constexpr std::string_view call_of_grouped = "packet16";

/// The recording from front to back, a part at a time.
void run_replay(benchmark::State& state, const Replay& replay, std::string_view call,
                std::span<const ShadowRay> all)
{
    constexpr std::size_t part = 4096;
    std::size_t first = 0, asked = 0;
    double seconds = 0;
    for (auto _ : state) {
        const auto rays = all.subspan(first, std::min(part, all.size() - first));
        const double start = thread_seconds();
        benchmark::DoNotOptimize(replay.embree.hidden(call, rays));
        seconds += thread_seconds() - start;
        asked += rays.size();
        first = (first + part) % all.size() < part ? 0 : first + part;
        if (first >= all.size()) first = 0;
    }
    state.counters["ns_per_ray"] = 1e9 * seconds / static_cast<double>(asked);
    state.counters["rays"] = static_cast<double>(all.size());
}

/// Do engine and bare Embree agree on which share of the rays is hidden? Spheres are the engine's
/// own, in double: not to the last ray.
void compare_answers(benchmark::State& state, const Replay& replay)
{
    for (auto _ : state) {
        const std::size_t bare = replay.embree.hidden("single", replay.recording.rays);
        const auto all = static_cast<double>(replay.recording.rays.size());
        state.counters["difference"] =
            std::abs(static_cast<double>(bare) - static_cast<double>(replay.recording.hidden)) /
            all;
        state.counters["hidden_share"] = static_cast<double>(bare) / all;
    }
}

/// The quickest of Embree's calls.
std::pair<std::string, Middle> best_call(const Figures& figures, const std::string& scene,
                                         const std::string& strategy)
{
    std::pair<std::string, Middle> best;
    for (const std::string_view call : BareEmbree::calls()) {
        const Middle ns = figures.at(replay(scene, strategy, call), "ns_per_ray");
        if (!best.second.is_known() || ns.median < best.second.median)
            best = {std::string(call), ns};
    }
    return best;
}

}  // namespace

void add_rays()
{
    for (const std::string& scene : scenes) {
        const LazyReady ready = ready_lazily([=] { return shipped_scene(scene); });
        for (const std::string& strategy : strategies) {
            benchmark::RegisterBenchmark(whole(scene, strategy).c_str(),
                                         [=](benchmark::State& state) {
                                             run_tiles(state, ready(), strategy, kernels<float>());
                                         });
            const auto recorded = lazily<Replay>([=] { return new Replay(ready(), strategy); });
            for (const std::string_view call : BareEmbree::calls())
                benchmark::RegisterBenchmark(
                    replay(scene, strategy, call).c_str(), [=](benchmark::State& state) {
                        run_replay(state, recorded(), call, recorded().recording.rays);
                    });
            const auto sorted = lazily<std::vector<ShadowRay>>(
                [=] { return new std::vector<ShadowRay>(grouped(recorded().recording.rays)); });
            benchmark::RegisterBenchmark(
                replay(scene, strategy, "grouped").c_str(), [=](benchmark::State& state) {
                    run_replay(state, recorded(), call_of_grouped, sorted());
                });
            benchmark::RegisterBenchmark(
                replay(scene, strategy, "answers").c_str(),
                [=](benchmark::State& state) { compare_answers(state, recorded()); })
                ->Iterations(1)
                ->Repetitions(1);
        }
    }
}

Bars ray_bars(const Figures& figures)
{
    Bars bars;
    Middle without = sample_without_rays(figures);
    if (without.median > 40) without = exactly(40);  // missing bar 1 must not widen bar 2
    for (const std::string& scene : scenes)
        for (const std::string& strategy : strategies) {
            const std::string name = whole(scene, strategy);
            const auto [call, ns_per_ray] = best_call(figures, scene, strategy);
            const Middle ns = figures.at(name, "ns_per_sample"),
                         rays = figures.at(name, "rays_per_sample");
            const Middle budget =
                without + (1.2 * rays.median) * ns_per_ray + figures.at(name, "ns_prepare");
            bars.push_back(
                {2, "time / budget, " + scene + ", " + strategy, ns / budget, Bar::Sense::at_most,
                 1,
                 fmt::format("{:.0f} of {:.0f} ns; {:.2f} rays of {:.0f} ns ({})", ns.median,
                             budget.median, rays.median, ns_per_ray.median, call)});
        }
    for (const std::string& scene : scenes) {
        std::vector<std::string_view> calls = BareEmbree::calls();
        calls.push_back("grouped");
        for (const std::string_view call : calls)
            bars.push_back({2, fmt::format("bare Embree, ns per ray, {}, {}", scene, call),
                            figures.at(replay(scene, strategies.front(), call), "ns_per_ray"),
                            Bar::Sense::report});
    }
    return bars;
}

}  // namespace mis::bench
