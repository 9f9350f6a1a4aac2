// Bars 1 and 7: one MIS sample without rays, per BSDF, instruction set and number type.
#include "bench/ready.h"
#include "bench/subjects.h"

namespace mis::bench {

namespace {

const std::string of_bar_1 = "solid-angle/power";
const std::vector<std::string> bsdfs{"lambert", "blinn", "ggx"};

std::string name_of_run(const std::string& bsdf, std::string_view isa, const std::string& number)
{
    return "without_rays/" + bsdf + "/" + std::string(isa) + "/" + number;
}

Part of_bsdf(const Ready& ready, const std::string& bsdf)
{
    for (std::size_t m = 0; m < ready.scene.materials.size(); ++m)
        if (ready.scene.materials[m].type == bsdf && !ready.tiles_of(static_cast<int>(m)).empty())
            return {.material = static_cast<int>(m)};
    return {};
}

/// The set that the bars speak of: AVX2 where there is such a thing, else the best.
std::string_view judged_set()
{
    const std::vector<std::string_view> sets = instruction_sets();
    for (const std::string_view isa : sets)
        if (isa == "avx2") return isa;
    return sets.front();
}

}  // namespace

void add_kernels()
{
    const LazyReady blinn = ready_lazily([] { return shipped_scene("veach-blinn"); }, Effect::none);
    const LazyReady ggx = ready_lazily([] { return shipped_scene("veach"); }, Effect::none);
    for (const std::string_view isa : instruction_sets())
        for (const std::string& bsdf : bsdfs) {
            const LazyReady ready = bsdf == "ggx" ? ggx : blinn;
            benchmark::RegisterBenchmark(
                name_of_run(bsdf, isa, "float").c_str(), [=](benchmark::State& state) {
                    run_tiles(state, ready(), of_bar_1, kernels_of<float>(isa),
                              of_bsdf(ready(), bsdf));
                });
            benchmark::RegisterBenchmark(
                name_of_run(bsdf, isa, "double").c_str(), [=](benchmark::State& state) {
                    run_tiles(state, ready(), of_bar_1, kernels_of<double>(isa),
                              of_bsdf(ready(), bsdf));
                });
        }
}

Middle sample_without_rays(const Figures& figures)
{
    Middle dearest;
    for (const std::string& bsdf : bsdfs) {
        const Middle one =
            figures.at(name_of_run(bsdf, instruction_sets().front(), "float"), "ns_per_sample");
        if (!dearest.is_known() || one.median > dearest.median) dearest = one;
    }
    return dearest;
}

Bars kernel_bars(const Figures& figures)
{
    Bars bars;
    const std::string isa(judged_set());
    const auto ns = [&](const std::string& bsdf, std::string_view set, const std::string& number) {
        return figures.at(name_of_run(bsdf, set, number), "ns_per_sample");
    };
    for (const std::string& bsdf : bsdfs)
        bars.push_back({1, "scalar / " + isa + ", " + bsdf,
                        ns(bsdf, "scalar", "float") / ns(bsdf, isa, "float"), Bar::Sense::at_least,
                        4});
    for (const std::string& bsdf : bsdfs)
        bars.push_back({1, "ns per sample without rays, " + bsdf + ", " + isa,
                        ns(bsdf, isa, "float"), Bar::Sense::at_most, 40});
    for (const std::string& bsdf : bsdfs)
        bars.push_back({7, "double / float, " + bsdf + ", " + isa,
                        ns(bsdf, isa, "double") / ns(bsdf, isa, "float"), Bar::Sense::report});
    return bars;
}

}  // namespace mis::bench
