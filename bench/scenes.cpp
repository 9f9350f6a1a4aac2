// Whole strategies on every scene that is shipped.
#include "bench/ready.h"
#include "bench/subjects.h"

#include <filesystem>
#include <set>

namespace mis::bench {

void add_scenes()
{
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(source_path("scenes")))
        if (entry.path().extension() == ".json") names.insert(entry.path().stem());
    for (const std::string& name : names) {
        const LazyReady ready = ready_lazily([=] { return shipped_scene(name); });
        for (const char* strategy : {"uniform/power", "power/power", "radiant-solid-angle/power",
                                     "radiant-solid-angle/light", "product/light", "brdf"})
            benchmark::RegisterBenchmark(("scene/" + name + "/" + strategy).c_str(),
                                         [=](benchmark::State& state) {
                                             run_tiles(state, ready(), strategy, kernels<float>());
                                         });
    }
}

}  // namespace mis::bench
