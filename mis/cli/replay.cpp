#include "mis/engine/replay.h"
#include "mis/cli/commands.h"
#include "mis/cli/ready.h"
#include "mis/strategy/names.h"
#include "mis/study/study_points.h"

#include <fmt/format.h>

#include <algorithm>

namespace mis::cli {

namespace {

struct Found {
    const Tile* tile;
    const ShadingPoint* point;
};

/// Throws UsageError where no point that can be lit has that id.
Found find_point(const StudyPoints& points, std::uint32_t id, const std::string& scene)
{
    for (const Tile& tile : points.shading.tiles) {
        const auto own = std::span(points.shading.points).subspan(tile.first, tile.count);
        const auto at =
            std::find_if(own.begin(), own.end(), [&](const ShadingPoint& p) { return p.id == id; });
        if (at != own.end()) return {&tile, &*at};
    }
    throw UsageError(fmt::format(
        "--point: found {}, which is no point of {} that can be lit\n    A point's number is its "
        "pixel's, row by row from the top, at the same --resolution; after all pixels, the "
        "probe's.",
        id, scene));
}

/// A figure, or a dash where no stage has come to it yet.
std::string cell(double value) { return value == 0 ? "-" : fmt::format("{:.4g}", value); }

std::string described(const ReplayStep& s)
{
    if (!s.is_alive) return "nothing is left of this draw";
    const std::string light = s.light == no_light ? "-" : std::to_string(s.light);
    if (s.stage == StageKind::numbers)
        return fmt::format("random numbers {:.9g} {:.9g} {:.9g}", s.u, s.v, s.lobe);
    if (s.stage == StageKind::draw)
        return fmt::format("{:>5} direction {:.7g} {:.7g} {:.7g}", light, s.wi.x, s.wi.y, s.wi.z);
    const Vec3<double>& c = s.contribution;
    const bool has_value = c != Vec3<double>(0);
    return fmt::format("{:>5} {:>8} {:>9} {:>9}  {}", light, cell(s.probability), cell(s.light_pdf),
                       cell(s.bsdf_pdf),
                       has_value ? fmt::format("{:.4g} {:.4g} {:.4g}", c.x, c.y, c.z) : "-");
}

void print_steps(const Replay& replay)
{
    fmt::print("\n{:<7} {:<15} {:>5} {:>8} {:>9} {:>9}  {}\n", "draw", "after", "light", "P(light)",
               "p light", "p bsdf", "f cos, then contribution");
    for (const ReplayStep& s : replay.steps)
        fmt::print("{:<7} {:<15} {}\n",
                   fmt::format("{} {}", s.is_light_half ? "light" : "bsdf", s.draw),
                   stage_names[static_cast<std::size_t>(s.stage)], described(s));
}

NumberSource numbers_of(const ReplayOptions& options)
{
    return {options.run.seed, options.run.is_sobol() ? options.at.value_or(one_scrambling) : 0};
}

void check_at(const ReplayOptions& options)
{
    if (!options.at) return;
    if (!options.run.is_sobol())
        throw UsageError("--at: samples of one scrambling are meant; it takes --sampler sobol");
    if (*options.at < 1 || *options.at > one_scrambling)
        throw UsageError(
            fmt::format("--at: found {}; 1 to {} samples of one scrambling are allowed",
                        *options.at, one_scrambling));
}

template <class T>
Vec3<double> run_in(const ReplayOptions& options, const LitScene& lit, const Strategy& strategy,
                    const Found& found, bool prints)
{
    const ReadyStrategy<T> ready(lit, strategy, kernels<T>(), numbers_of(options), {},
                                 interrupt_token());
    const Replay again =
        replay(lit, ready, *found.tile, *found.point, options.sample, interrupt_token());
    if (prints) print_steps(again);
    return again.value;
}

}  // namespace

int run_replay(const ReplayOptions& options)
{
    check_at(options);
    const Strategy strategy = parse_strategy(options.strategy);
    const ReadyScene ready(options.scene, options.run);
    const StudyPoints points = find_study_points(ready.lit, ready.stoppable_executor());
    const Found found = find_point(points, options.point, options.scene);
    const Vec3<double>& x = found.point->x;
    fmt::print("{}: {}, point {} at {:.6g} {:.6g} {:.6g}, sample {}, seed {}, {}\n", options.scene,
               name_of(strategy), options.point, x.x, x.y, x.z, options.sample, options.run.seed,
               kernels<float>().instruction_set);
    const Vec3<double> in_float = run_in<float>(options, ready.lit, strategy, found, true),
                       in_double = run_in<double>(options, ready.lit, strategy, found, false);
    fmt::print("\nvalue in float   {:.9g} {:.9g} {:.9g}\nvalue in double  {:.9g} {:.9g} {:.9g}\n",
               in_float.x, in_float.y, in_float.z, in_double.x, in_double.y, in_double.z);
    return ok;
}

}  // namespace mis::cli
