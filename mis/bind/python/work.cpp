#include "mis/bind/python/work.h"

#include "mis/math/limits.h"
#include "mis/run/tbb.h"
#include "mis/scene/nearest_name.h"
#include "mis/study/at_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace mis::python {

namespace {

constexpr std::int64_t most_samples = std::int64_t{1} << 40;

/// Throws ArgumentError unless low ≤ value ≤ high.
void check_range(const char* name, std::int64_t value, std::int64_t low, std::int64_t high)
{
    if (value < low || value > high)
        throw ArgumentError(
            fmt::format("{}: found {}; {} to {} are allowed", name, value, low, high));
}

AnyExecutor executor_of(const Run& run)
{
    check_range("threads", run.threads, 0, 1024);
    return any_executor(TbbExecutor(run.threads));
}

std::vector<Strategy> parsed(const std::vector<std::string>& names)
{
    if (names.empty()) throw ArgumentError("strategies: found none; name at least one");
    std::vector<Strategy> strategies;
    for (const std::string& name : names) strategies.push_back(parse_sample_strategy(name));
    return strategies;
}

NumberSource source_of(const std::string& sampler, std::uint64_t seed)
{
    if (sampler != "independent" && sampler != "sobol")
        throw ArgumentError(
            "sampler: found \"" + sampler + "\"; known are independent, sobol\n    " +
            did_you_mean(sampler, std::array<std::string_view, 2>{"independent", "sobol"},
                         "Give one of them."));
    return {seed, sampler == "sobol" ? one_scrambling : 0};
}

}  // namespace

ReadyScene::ReadyScene(Scene s, const StopToken& stop)
    : scene(std::move(s)),
      tracer(scene.surfaces.empty() ? nullptr : std::make_unique<EmbreeTracer>(scene, stop)),
      lit(scene, tracer.get(), called_for(scene), stop)
{
}

Picture render(const ReadyScene& ready, const std::string& strategy, std::int64_t spp,
               const std::string& sampler, const Run& run)
{
    if (!ready.scene.camera)
        throw ArgumentError(ready.scene.file + ": found no camera; a picture needs one");
    check_range("spp", spp, 1, most_samples);
    const AnyExecutor executor = executor_of(run);
    const ReadyStrategy<float> prepared(ready.lit, parse_sample_strategy(strategy),
                                        kernels<float>(), source_of(sampler, run.seed), {},
                                        run.token());
    const auto [width, height] = ready.scene.camera->resolution;
    const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    Picture picture{.image = {width, height, std::vector<Vec3<float>>(pixels, Vec3<float>(0.0F))},
                    .variance = std::vector<double>(pixels, nan)};
    WorkspacePool<float> workspaces;
    Band band = find_band(ready.lit, 0, height, stoppable(executor, run.token()));
    constexpr std::int64_t step = 16;
    for (std::int64_t s = 0; s < spp; s += step) {
        picture.invalid +=
            light_band(prepared, band, static_cast<std::uint64_t>(s),
                       static_cast<int>(std::min(step, spp - s)), workspaces, executor, run.token())
                .invalid;
        run.token().check();
    }
    draw_band(ready.lit, band, picture.image);
    for (std::size_t p = 0; p < band.results.size(); ++p)
        picture.variance[band.shading.points[p].id] = band.results[p].luminance.variance();
    for (const std::uint32_t id : band.shading.dark) picture.variance[id] = 0;
    return picture;
}

namespace {

/// The shading point of a place, alone in its tile; nothing where no light reaches it.
struct OnePoint {
    GBuffer buffer;
    const Tile* tile = nullptr;
    const ShadingPoint* point = nullptr;
};

OnePoint found(const ReadyScene& ready, const Place& place, const AnyExecutor& executor)
{
    OnePoint one;
    const Scene& scene = ready.scene;
    std::int64_t id = 0;
    const std::array<int, 2> size = scene.camera ? scene.camera->resolution : std::array{0, 0};
    if (const auto* probe = std::get_if<std::int64_t>(&place)) {
        if (scene.probes.empty())
            throw ArgumentError(scene.file + ": found no probes; name a pixel");
        check_range("probe", *probe, 0, static_cast<std::int64_t>(scene.probes.size()) - 1);
        one.buffer = probe_points(scene, ready.lit.lights(), ready.tracer.get(), executor);
        id = std::int64_t{size[0]} * size[1] + *probe;
    } else {
        const auto [column, row] = std::get<std::array<std::int64_t, 2>>(place);
        if (!scene.camera)
            throw ArgumentError(scene.file + ": found no camera, so no pixels; name a probe");
        check_range("pixel: column", column, 0, size[0] - 1);
        check_range("pixel: row", row, 0, size[1] - 1);
        one.buffer = find_shading_points(scene, ready.lit.lights(), ready.tracer.get(),
                                         static_cast<int>(row), 1, executor);
        id = row * size[0] + column;
        for (const Background& empty : one.buffer.background)
            if (empty.pixel == id)
                throw ArgumentError(fmt::format("pixel: found no surface at {}, {}", column, row));
    }
    for (const Tile& tile : one.buffer.tiles)
        for (std::uint32_t p = tile.first; p < tile.first + tile.count; ++p)
            if (one.buffer.points[p].id == id) one.tile = &tile, one.point = &one.buffer.points[p];
    return one;
}

}  // namespace

std::vector<double> samples(const ReadyScene& ready, const std::string& strategy,
                            const Place& place, std::int64_t count, std::int64_t first,
                            const std::string& sampler, const Run& run)
{
    check_range("count", count, 0, most_samples);
    check_range("first", first, 0, most_samples);
    const AnyExecutor executor = stoppable(executor_of(run), run.token());
    const ReadyStrategy<float> prepared(ready.lit, parse_sample_strategy(strategy),
                                        kernels<float>(), source_of(sampler, run.seed), {},
                                        run.token());
    const OnePoint one = found(ready, place, executor);
    std::vector<double> values(static_cast<std::size_t>(count), 0.0);
    if (one.point == nullptr) return values;

    constexpr std::size_t block = 1 << 14;
    const std::size_t blocks = (values.size() + block - 1) / block;
    WorkspacePool<float> workspaces;
    const StopToken stop = run.token();
    TileJob<float> job = prepared.job(*one.tile, {one.point, 1});
    job.stop = &stop;
    executor.for_each(blocks, [&](std::size_t b) {
        const std::size_t begin = b * block;
        const std::size_t size = std::min(block, values.size() - begin);
        std::vector<ChunkTotals> each(size);  // a chunk of one sample has its luminance
        PointResult result;
        workspaces.with([&](Workspace<float>& workspace) {
            workspace.run(job, prepared.pipeline(one.tile->material),
                          {.first = static_cast<std::uint64_t>(first) + begin,
                           .chunk = 1,
                           .chunks = static_cast<int>(size)},
                          {&result, 1}, {}, each);
        });
        for (std::size_t i = 0; i < size; ++i) values[begin + i] = each[i].mean;
    });
    return values;
}

namespace {

/// Samples of one scrambling, of which variances are then: at least two replicates of two. 0: of
/// independent samples.
std::uint64_t samples_per_scrambling(const CompareOptions& options)
{
    if (source_of(options.sampler, 0).samples_per_scrambling == 0) return 0;
    if (!(options.at <= 65536) || options.at != std::floor(options.at))
        throw ArgumentError(
            fmt::format("at: found {}; with sampler \"sobol\" it is the samples of one scrambling, "
                        "a whole number from 1 to 65536",
                        options.at));
    const auto at = static_cast<std::int64_t>(options.at);
    if (options.spp && (*options.spp < 4 * at || *options.spp % at != 0))
        throw ArgumentError(fmt::format(
            "spp: found {}; with sampler \"sobol\" it is a multiple of at ({}), and at least {}",
            *options.spp, at, 4 * at));
    return static_cast<std::uint64_t>(at);
}

}  // namespace

Report compare(const ReadyScene& ready, const std::vector<std::string>& strategies,
               const CompareOptions& options, const Run& run)
{
    std::vector<Strategy> list;
    for (const Strategy& strategy : parsed(strategies))
        if (std::find(list.begin(), list.end(), strategy) == list.end()) list.push_back(strategy);
    if (options.spp.has_value() + options.seconds.has_value() + options.error.has_value() > 1)
        throw ArgumentError(
            "spp, seconds and error: found more than one; give one of them, or none");
    if (options.spp) check_range("spp", *options.spp, 4, most_samples);
    if (options.seconds && !(*options.seconds > 0 && *options.seconds <= 1e7))
        throw ArgumentError(
            fmt::format("seconds: found {}; a time is greater than 0 and at most 1e7 seconds",
                        *options.seconds));
    if (options.error && !(*options.error > 0 && *options.error < 10))
        throw ArgumentError(fmt::format(
            "error: found {}; a relative error is greater than 0 and below 10", *options.error));
    if (!(options.at > 0 && options.at <= 1e12))
        throw ArgumentError(fmt::format(
            "at: found {}; more than 0 and at most 1e12 samples per point", options.at));
    const AnyExecutor executor = executor_of(run);

    StudyOptions study;
    study.seed = run.seed, study.at = options.at;
    study.samples_per_scrambling = samples_per_scrambling(options);
    if (options.spp) study.spp = static_cast<std::uint64_t>(*options.spp);
    study.seconds = options.seconds, study.error = options.error;
    study.stop = run.stop;
    const Study found = run_study_at(ready.lit, list, study, {}, executor);
    run.token().check();
    if (found.points->figure_points == 0)
        throw ArgumentError(ready.scene.file + ": found nothing to light: no surface is in view");
    Report report{{.version = MIS_VERSION}};
    report.seed = run.seed, report.at = options.at, report.threads = executor.threads;
    report.is_sobol = study.samples_per_scrambling > 0;
    report.instruction_set = kernels<float>().instruction_set;
    report.partial = found.report.partial;
    report.scenes.push_back(found.report);
    return report;
}

std::vector<Predicted> predict(const ReadyScene& ready, const std::vector<std::string>& strategies,
                               const Run& run)
{
    const std::vector<Strategy> list = parsed(strategies);
    const Scene& scene = ready.scene;
    if (scene.probes.empty())
        throw ArgumentError(scene.file +
                            ": found no probes; predict answers at probes alone\n"
                            "    Add \"probes\" to the scene.");
    std::vector<std::vector<Predicted>> of_probes(scene.probes.size());
    const AnyExecutor executor = stoppable(executor_of(run), run.token());
    executor.for_each(scene.probes.size(), [&](std::size_t p) {
        of_probes[p] = mis::predict(scene, scene.probes[p], list, {},
                                    {.executor = &executor, .stop = run.token()});
    });
    std::vector<Predicted> all;
    for (const auto& probe : of_probes) all.insert(all.end(), probe.begin(), probe.end());
    return all;
}

}  // namespace mis::python
