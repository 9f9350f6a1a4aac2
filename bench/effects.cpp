// What it saves to simulate only what each tile calls for.
#include "bench/ready.h"
#include "bench/subjects.h"
#include "mis/engine/stopwatch.h"
#include "mis/run/serial.h"

#include <fmt/format.h>

#include <array>

namespace mis::bench {

namespace {

struct Expected {
    const char* scene;
    double at_least;  ///< time of everything, over that of what is called for
};
constexpr Expected expected[]{{"single", 2},        {"lecture", 2},    {"hundred", 1.3},
                              {"street", 1.3},      {"veach", 0.97},   {"overlap", 0.97},
                              {"eclipse", 0.97},    {"horizon", 0.97}, {"sun-and-lamp", 0.97},
                              {"veach-blinn", 0.97}};

/// Samples of a run that is over soon, and scenes of which a tile's plan keeps lists.
constexpr std::array short_runs{16, 64, 256};
const std::vector<std::string> scenes_with_lists{"hundred", "street"};

std::string name_of(const std::string& scene, const std::string& effects)
{
    return "effects/" + scene + "/" + effects;
}
std::string name_of(const std::string& scene, const std::string& effects, int samples)
{
    return fmt::format("{}/first-{}", name_of(scene, effects), samples);
}

/// The plan of a whole picture.
void run_plan(benchmark::State& state, const Ready& ready)
{
    double seconds = 0;
    for (auto _ : state) {
        GBuffer shading = ready.shading;
        const double start = thread_seconds();
        ready.lit.plan(shading, any_executor(SerialExecutor{}));
        seconds += thread_seconds() - start;
    }
    state.counters["plan_seconds"] = seconds / static_cast<double>(state.iterations());
}

/// One tile after the other, each planned anew and given so many samples of every point, of which
/// it knows: ns_per_sample counts the plan as well.
void run_anew(benchmark::State& state, const Ready& ready, int samples)
{
    ready.lit.expect_samples(samples);
    const ReadyStrategy<float> prepared(ready.lit, parse_strategy("uniform/power"),
                                        kernels<float>(), 1);
    Workspace<float> workspace;
    TileTotals totals;
    double planning = 0;
    std::size_t t = 0;
    for (auto _ : state) {
        const GBuffer& all = ready.shading;
        const Tile& of = all.tiles[(t += 7) % all.tiles.size()];  // all over the picture
        GBuffer one;
        const auto points = std::span(all.points).subspan(of.first, of.count);
        one.points.assign(points.begin(), points.end());
        one.tiles.push_back({0, of.count, of.material, of.origin});
        const double start = thread_seconds();
        ready.lit.plan(one, any_executor(SerialExecutor{}));
        planning += thread_seconds() - start;
        std::vector<PointResult> results(of.count);
        const Tile& tile = one.tiles.front();
        totals.add(workspace.run(
            prepared.job(tile, one.points), prepared.pipeline(tile),
            {.chunk = samples_per_point, .chunks = samples / samples_per_point}, results, {}, {}));
    }
    const auto count = static_cast<double>(std::max<std::uint64_t>(totals.samples, 1));
    state.counters["ns_per_sample"] = 1e9 * (totals.seconds + planning) / count;
}

}  // namespace

void add_effects()
{
    for (const Expected& e : expected) {
        const std::string scene = e.scene;
        for (const auto& [word, effect] :
             {std::pair{"all", Effect::everything}, std::pair{"auto", Effect::called_for}}) {
            const LazyReady ready = ready_lazily([=] { return shipped_scene(scene); }, effect);
            benchmark::RegisterBenchmark(
                name_of(scene, word).c_str(), [=](benchmark::State& state) {
                    run_tiles(state, ready(), "uniform/power", kernels<float>());
                });
            if (effect == Effect::called_for)
                benchmark::RegisterBenchmark(
                    name_of(scene, "plan").c_str(),
                    [=](benchmark::State& state) { run_plan(state, ready()); });
        }
    }
    for (const std::string& scene : scenes_with_lists)
        for (const auto& [word, effect] :
             {std::pair{"all", Effect::everything}, std::pair{"auto", Effect::called_for}}) {
            const LazyReady ready = ready_lazily([=] { return shipped_scene(scene); }, effect);
            for (const int samples : short_runs)
                benchmark::RegisterBenchmark(
                    name_of(scene, word, samples).c_str(),
                    [=](benchmark::State& state) { run_anew(state, ready(), samples); });
        }
}

Bars effect_bars(const Figures& figures)
{
    Bars bars;
    for (const Expected& e : expected) {
        const Middle all = figures.at(name_of(e.scene, "all"), "ns_per_sample"),
                     leaner = figures.at(name_of(e.scene, "auto"), "ns_per_sample");
        const Middle saved = all - leaner;
        bars.push_back({8, std::string("effects all / auto, ") + e.scene, all / leaner,
                        Bar::Sense::at_least, e.at_least,
                        fmt::format("saves {:.0f} of {:.0f} ns", saved.median, all.median)});
    }
    for (const std::string& scene : scenes_with_lists)
        for (const int samples : short_runs) {
            const Middle all = figures.at(name_of(scene, "all", samples), "ns_per_sample"),
                         leaner = figures.at(name_of(scene, "auto", samples), "ns_per_sample");
            bars.push_back({8,
                            fmt::format("the same, {}, the first {} samples alone", scene, samples),
                            all / leaner, Bar::Sense::at_least, 0.97,
                            fmt::format("{:.0f} and {:.0f} ns", all.median, leaner.median)});
        }
    for (const Expected& e : expected)
        bars.push_back({8, std::string("planning, share of a second, ") + e.scene,
                        figures.at(name_of(e.scene, "plan"), "plan_seconds"), Bar::Sense::at_most,
                        0.02});
    return bars;
}

}  // namespace mis::bench
