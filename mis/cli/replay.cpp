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

/// The number of the point that is asked for. Throws UsageError where that is no pixel.
std::uint32_t point_id(const ReplayOptions& options, const Scene& scene)
{
    if (options.point) return *options.point;
    const auto [x, y] = *options.pixel;
    if (!scene.camera)
        throw UsageError(fmt::format("--pixel: {} has no camera; its probes go by --point 0, 1, …",
                                     options.scene));
    const auto [width, height] = scene.camera->resolution;
    if (x >= width || y >= height)
        throw UsageError(
            fmt::format("--pixel: found {},{}; the picture is {}x{}, so pixels go from "
                        "0,0 to {},{}",
                        x, y, width, height, width - 1, height - 1));
    return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width) +
           static_cast<std::uint32_t>(x);
}

[[noreturn]] void refuse_point(const ReplayOptions& options)
{
    if (options.pixel)
        throw UsageError(
            fmt::format("--pixel: found {},{}, where {} shows no surface that can be "
                        "lit\n    Take another pixel, at the same --resolution.",
                        (*options.pixel)[0], (*options.pixel)[1], options.scene));
    throw UsageError(fmt::format(
        "--point: found {}, which is no point of {} that can be lit\n    A point's number is its "
        "pixel's, row by row from the top, at the same --resolution; after all pixels, the "
        "probe's.",
        *options.point, options.scene));
}

/// Throws UsageError where no point that can be lit has that id.
Found find_point(const StudyPoints& points, std::uint32_t id, const ReplayOptions& options)
{
    for (const Tile& tile : points.shading.tiles) {
        const auto own = std::span(points.shading.points).subspan(tile.first, tile.count);
        const auto at =
            std::find_if(own.begin(), own.end(), [&](const ShadingPoint& p) { return p.id == id; });
        if (at != own.end()) return {&tile, &*at};
    }
    refuse_point(options);
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

void check(const ReplayOptions& options)
{
    if (options.point.has_value() == options.pixel.has_value())
        throw UsageError(fmt::format("--point and --pixel: found {}; give one of them",
                                     options.point ? "both" : "neither"));
    if (options.at && !options.run.is_sobol())
        throw UsageError("--at: samples of one scrambling are meant; it takes --sampler sobol");
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
    check(options);
    const Strategy strategy = parse_sample_strategy(options.strategy);
    const ReadyScene ready(options.scene, options.run);
    const std::uint32_t id = point_id(options, ready.scene);
    const StudyPoints points = find_study_points(ready.lit, ready.stoppable_executor());
    const Found found = find_point(points, id, options);
    const Vec3<double>& x = found.point->x;
    fmt::print("{}: {}, point {} at {:.6g} {:.6g} {:.6g}, sample {}, seed {}, {}\n", options.scene,
               name_of(strategy), id, x.x, x.y, x.z, options.sample, options.run.seed,
               kernels<float>().instruction_set);
    const Vec3<double> in_float = run_in<float>(options, ready.lit, strategy, found, true),
                       in_double = run_in<double>(options, ready.lit, strategy, found, false);
    fmt::print("\nvalue in float   {:.9g} {:.9g} {:.9g}\nvalue in double  {:.9g} {:.9g} {:.9g}\n",
               in_float.x, in_float.y, in_float.z, in_double.x, in_double.y, in_double.z);
    return ok;
}

}  // namespace mis::cli
