// How exact shared samples are, by strategy, and what a direction takes:
//   mis_shared_samples SCENE.json [POINTS [ROUNDS [STRATEGY…]]]
#include "mis/engine/stopwatch.h"
#include "mis/io/scene_json.h"
#include "mis/run/serial.h"
#include "mis/study/shared_samples.h"
#include "mis/study/study_points.h"
#include "mis/trace/embree.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace mis {
namespace {

/// The default list of `compare`, and some that stand alone.
std::vector<Strategy> usual_strategies()
{
    std::vector<Strategy> all;
    for (const char* policy : {"uniform", "power", "solid-angle", "radiant-solid-angle", "product",
                               "irradiance", "tree", "all"})
        for (const char* heuristic : {"light", "balance", "power"})
            all.push_back(parse_strategy(std::string(policy) + "/" + heuristic));
    for (const char* name : {"product/light/projected", "product/power/one-sample", "brdf"})
        all.push_back(parse_strategy(name));
    return all;
}

int measure(const std::string& file, std::size_t most_points, int rounds,
            const std::vector<Strategy>& strategies)
{
    const Scene scene = read_scene(file);
    const EmbreeTracer tracer(scene);
    const LitScene lit(scene, &tracer, called_for(scene));
    const AnyExecutor serial = any_executor(SerialExecutor{});
    const StudyPoints study = find_study_points(lit, serial);
    std::vector<SharedPoint> points;
    for (const std::size_t p : spread_points(study, most_points))
        points.push_back({study.shading.points[p], study.material_of(p)});
    SharedSamples shared(lit, points, strategies, {});
    const SharedCounts counts;
    shared.take(1, serial);
    const double start = thread_seconds();
    shared.take(rounds, serial);
    const double directions =
        static_cast<double>(shared_groups) * counts.all() * rounds * double(points.size());
    fmt::print("{}: {} points, {} rounds of {} directions, {:.0f} ns of CPU per direction\n",
               scene.name, points.size(), rounds, shared_groups * std::size_t(counts.all()),
               1e9 * (thread_seconds() - start) / directions);
    fmt::print("{:32} {:>12} {:>10} {:>28}\n", "strategy", "variance", "rel. error",
               "rel. error × √directions");
    for (std::size_t s = 0; s < strategies.size(); ++s) {
        // Directions of one point: the error of the mean over N points is that of N times as many.
        const ValueAndError v = shared.mean(s);
        const double relative = v.se / std::abs(v.value);
        fmt::print("{:32} {:12.5g} {:10.2g} {:28.2f}{}\n", name_of(strategies[s]), v.value,
                   relative, relative * std::sqrt(directions),
                   shared.missed(s) > 0 ? "  biased" : "");
    }
    return 0;
}

}  // namespace
}  // namespace mis

int main(int count, char** words)
{
    if (count < 2) return 2;
    std::vector<mis::Strategy> strategies;
    for (int i = 4; i < count; ++i) strategies.push_back(mis::parse_strategy(words[i]));
    return mis::measure(words[1], count > 2 ? std::strtoul(words[2], nullptr, 10) : 256,
                        count > 3 ? std::atoi(words[3]) : 16,
                        strategies.empty() ? mis::usual_strategies() : strategies);
}
