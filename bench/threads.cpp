// Bar 4: two threads against one, by the wall clock, and to the last bit.
#include "bench/ready.h"
#include "bench/subjects.h"
#include "mis/engine/render.h"
#include "mis/run/tbb.h"

#include <chrono>
#include <cstring>

namespace mis::bench {

namespace {

constexpr int samples = 8;

std::string run_of(int threads) { return "threads/" + std::to_string(threads); }

struct Picture {
    Band band;
    double seconds;  ///< of the wall clock
};

/// The scene's picture by one strategy.
Picture light(const Ready& ready, int threads)
{
    const ReadyStrategy<float> strategy(ready.lit, parse_strategy("power/power"), kernels<float>(),
                                        1);
    Picture picture{{ready.shading, {}}, 0};
    picture.band.results.resize(ready.shading.points.size());
    WorkspacePool<float> workspaces;
    const AnyExecutor executor = any_executor(TbbExecutor(threads));
    light_band(strategy, picture.band, 0, 1, workspaces, executor);  // memory and threads are there
    for (PointResult& result : picture.band.results) result = {};
    const auto start = std::chrono::steady_clock::now();
    light_band(strategy, picture.band, 0, samples, workspaces, executor);
    picture.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return picture;
}

bool are_same(const Band& a, const Band& b)
{
    static_assert(sizeof(PointResult) == 64, "no padding to compare");
    return a.results.size() == b.results.size() &&
           std::memcmp(a.results.data(), b.results.data(),
                       a.results.size() * sizeof(PointResult)) == 0;
}

}  // namespace

void add_threads()
{
    const LazyReady ready = ready_lazily([] { return shipped_scene("street"); });
    const auto reference = lazily<Picture>([=] { return new Picture(light(ready(), 1)); });
    for (const int threads : {1, 2})
        benchmark::RegisterBenchmark(run_of(threads).c_str(), [=](benchmark::State& state) {
            double seconds = 0, runs = 0, different = 0;
            for (auto _ : state) {
                const Picture picture = light(ready(), threads);
                seconds += picture.seconds, ++runs;
                different += !are_same(picture.band, reference().band);
            }
            state.counters["seconds"] = seconds / runs;
            state.counters["different_pictures"] = different;
        })->Iterations(1);
}

Bars thread_bars(const Figures& figures)
{
    return {{4, "2 threads over 1, street, power/power",
             figures.at(run_of(1), "seconds") / figures.at(run_of(2), "seconds"),
             Bar::Sense::at_least, 1.9},
            {4, "pictures of 2 threads that differ by a bit",
             figures.at(run_of(2), "different_pictures"), Bar::Sense::at_most, 0}};
}

}  // namespace mis::bench
