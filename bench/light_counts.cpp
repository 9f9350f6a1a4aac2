// Bar 5: cost against the number of lights, per policy, whole MIS samples with rays.
#include "bench/random_scene.h"
#include "bench/ready.h"
#include "bench/subjects.h"

#include <fmt/format.h>

namespace mis::bench {

namespace {

const std::vector<std::size_t> counts{1'000, 10'000, 100'000, 1'000'000};

std::string run_of(std::string_view policy, std::size_t lights)
{
    return fmt::format("lights/{}/{}", policy, lights);
}
std::string cloud_of(std::size_t lights) { return fmt::format("lights/cloud/{}", lights); }

bool is_linear(const PolicyStages<float>& policy)
{
    return policy.reads_all_lights && policy.table_bytes(1000) > 1000;
}

}  // namespace

void add_light_counts()
{
    for (const std::size_t lights : counts) {
        const LazyReady ready = ready_lazily([=] { return random_scene(lights); });
        for (const PolicyStages<float>& policy : kernels<float>().policies) {
            if (policy.draws_every_light) continue;  // a sample is a draw for each light
            const std::string strategy = std::string(policy.name) + "/power";
            auto* run = benchmark::RegisterBenchmark(
                run_of(policy.name, lights).c_str(), [=](benchmark::State& state) {
                    run_tiles(state, ready(), strategy, kernels<float>());
                    state.counters["prepare_ns_per_light"] =
                        static_cast<double>(state.counters["ns_prepare"]) * samples_per_point /
                        static_cast<double>(lights);
                });
            // Long enough to have met most of a million lights, for caches as they are in a run.
            if (!is_linear(policy) && lights > 100'000) run->MinTime(0.3);
        }
        const LazyReady cloud = ready_lazily([=] { return random_scene(lights, Layout::cloud); });
        benchmark::RegisterBenchmark(cloud_of(lights).c_str(), [=](benchmark::State& state) {
            run_tiles(state, cloud(), "uniform/power", kernels<float>());
        });
    }
}

Bars light_count_bars(const Figures& figures)
{
    Bars bars;
    const auto at = [&](std::string_view policy, std::size_t lights, const char* counter) {
        return figures.at(run_of(policy, lights), counter);
    };
    for (const char* policy : {"uniform", "power"})
        bars.push_back(
            {5, fmt::format("{}/power, 10^6 / 10^3 lights", policy),
             at(policy, 1'000'000, "ns_per_sample") / at(policy, 1'000, "ns_per_sample"),
             Bar::Sense::at_most, 3,
             fmt::format("{:.0f} and {:.0f} ns", at(policy, 1'000'000, "ns_per_sample").median,
                         at(policy, 1'000, "ns_per_sample").median)});
    // O(log M) doubles from 10^3 to 10^6, and caches miss beside; O(M^(1/3)) would be 10.
    bars.push_back({5, "which light is met, 10^6 / 10^3 lights",
                    at("uniform", 1'000'000, "ns_meet") / at("uniform", 1'000, "ns_meet"),
                    Bar::Sense::at_most, 5,
                    fmt::format("{:.0f} and {:.0f} ns", at("uniform", 1'000'000, "ns_meet").median,
                                at("uniform", 1'000, "ns_meet").median)});
    bars.push_back({5, "uniform/power in a volume, 10^6 / 10^3 lights",
                    figures.at(cloud_of(1'000'000), "ns_per_sample") /
                        figures.at(cloud_of(1'000), "ns_per_sample"),
                    Bar::Sense::report});
    for (const std::size_t lights : counts)
        bars.push_back(
            {5, fmt::format("tree/power over uniform/power, {} lights", lights),
             at("tree", lights, "ns_per_sample") / at("uniform", lights, "ns_per_sample"),
             lights == counts.back() ? Bar::Sense::at_most : Bar::Sense::report, 2,
             fmt::format("{:.0f} and {:.0f} ns", at("tree", lights, "ns_per_sample").median,
                         at("uniform", lights, "ns_per_sample").median)});
    for (const PolicyStages<float>& policy : kernels<float>().policies) {
        if (!is_linear(policy) || policy.draws_every_light) continue;
        for (const std::size_t lights : {counts.front(), counts.back()})
            bars.push_back({5, fmt::format("prepare, ns per light, {}, {}", policy.name, lights),
                            at(policy.name, lights, "prepare_ns_per_light"), Bar::Sense::at_most,
                            1});
    }
    return bars;
}

}  // namespace mis::bench
