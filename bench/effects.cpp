// What it saves to simulate only what each tile calls for.
#include "bench/ready.h"
#include "bench/subjects.h"

#include <fmt/format.h>

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

std::string name_of(const std::string& scene, const char* effects)
{
    return "effects/" + scene + "/" + effects;
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
        }
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
    return bars;
}

}  // namespace mis::bench
