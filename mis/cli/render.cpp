#include "mis/cli/commands.h"

#include "mis/cli/interrupt.h"
#include "mis/cli/progress.h"
#include "mis/cli/ready.h"
#include "mis/engine/render.h"
#include "mis/io/image_exr.h"
#include "mis/strategy/strategy.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace mis::cli {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// √ of the mean over the shading points of the estimate's variance over μ² + ε² (design §1).
double relative_error(const Band& band)
{
    double mean = 0;
    std::size_t points = 0;
    for (const PointResult& result : band.results) mean += result.luminance.mean, ++points;
    points += band.shading.dark.size();
    if (points == 0) return 0;
    const double epsilon = 0.01 * mean / static_cast<double>(points);
    double sum = 0;
    for (const PointResult& result : band.results) {
        const double n = static_cast<double>(result.luminance.count), mu = result.luminance.mean;
        if (result.luminance.m2 > 0)
            sum += result.luminance.variance() / n / (mu * mu + epsilon * epsilon);
    }
    return std::sqrt(sum / static_cast<double>(points));
}

/// What a render comes to, whichever way it stopped.
struct Outcome {
    Image image;
    std::uint64_t samples = 0, invalid = 0;  ///< samples: per shading point
    std::size_t shading_points = 0;
    double error = 0;
    bool is_partial = false;
    std::optional<int> unlit_from;  ///< first row without samples, where interrupted before them
};

/// A given number of samples: band by band, so that memory does not grow with the picture.
Outcome render_spp(const ReadyScene& ready, const ReadyStrategy<float>& strategy, std::uint64_t spp,
                   Progress& progress)
{
    constexpr int band_pixels = 1 << 20;
    const auto [width, height] = ready.scene.camera->resolution;
    const int band_rows =
        std::clamp(band_pixels / width / tile_side * tile_side, tile_side, height + tile_side);
    Outcome outcome;
    outcome.image = {
        width, height,
        std::vector<Vec3<float>>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                 Vec3<float>(0.0F))};
    outcome.samples = spp;
    WorkspacePool<float> workspaces;
    for (int row = 0; row < height && !outcome.is_partial; row += band_rows) {
        Band band = find_band(ready.lit, row, std::min(band_rows, height - row), ready.executor);
        constexpr std::uint64_t step = 16;
        std::uint64_t sampled = 0;
        for (std::uint64_t s = 0; s < spp && !outcome.is_partial; s += step) {
            const int count = static_cast<int>(std::min(step, spp - s));
            outcome.invalid +=
                light_band(strategy, band, s, count, workspaces, ready.executor, &interrupt_flag())
                    .invalid;
            sampled += static_cast<std::uint64_t>(count);
            outcome.is_partial = interrupt_flag();
            progress.show(
                "rendering",
                (row + double(band.shading.rows) * double(s + step) / double(spp)) / height);
        }
        outcome.shading_points += band.results.size() + band.shading.dark.size();
        draw_band(ready.lit, band, outcome.image);
        if (band.shading.rows == height) {
            outcome.samples = sampled;
            outcome.error = relative_error(band);
        } else if (outcome.is_partial) {
            outcome.unlit_from = row + band.shading.rows;
        }
    }
    return outcome;
}

/// Until a time or an error is reached: all of the picture at once, in doubling rounds.
Outcome render_until(const ReadyScene& ready, const ReadyStrategy<float>& strategy,
                     const StopOptions& stop, Progress& progress)
{
    const auto start = std::chrono::steady_clock::now();
    const auto [width, height] = ready.scene.camera->resolution;
    Outcome outcome;
    outcome.image = {
        width, height,
        std::vector<Vec3<float>>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                 Vec3<float>(0.0F))};
    WorkspacePool<float> workspaces;
    Band band = find_band(ready.lit, 0, height, ready.executor);
    outcome.shading_points = band.results.size() + band.shading.dark.size();
    int count = 4;
    bool is_done = false;
    while (!is_done) {
        const auto round = std::chrono::steady_clock::now();
        outcome.invalid += light_band(strategy, band, outcome.samples, count, workspaces,
                                      ready.executor, &interrupt_flag())
                               .invalid;
        outcome.samples += static_cast<std::uint64_t>(count);
        outcome.is_partial = interrupt_flag();
        outcome.error = relative_error(band);
        const double seconds_per_sample = seconds_since(round) / count;
        if (stop.seconds) {
            const double left = *stop.seconds - seconds_since(start);
            count = static_cast<int>(std::clamp(left / seconds_per_sample, 0.0, 64.0));
            is_done = count == 0;
            progress.show("rendering", seconds_since(start) / *stop.seconds);
        } else {
            const double wanted = *stop.error;
            is_done = outcome.error <= wanted;
            const double needed =
                double(outcome.samples) * (outcome.error * outcome.error / (wanted * wanted) - 1);
            count =
                static_cast<int>(std::clamp(needed, 1.0, std::min(64.0, double(outcome.samples))));
            progress.show("rendering", wanted * wanted / (outcome.error * outcome.error));
        }
        is_done = is_done || outcome.is_partial || band.results.empty();
    }
    draw_band(ready.lit, band, outcome.image);
    return outcome;
}

}  // namespace

namespace {

std::string interruption(const Outcome& outcome)
{
    if (!outcome.is_partial) return "";
    if (!outcome.unlit_from) return " (partial: interrupted)";
    return fmt::format(" (partial: interrupted; its last rows have fewer, and from row {} none)",
                       *outcome.unlit_from);
}

}  // namespace

int run_render(const RenderOptions& options)
{
    check(options.stop, 1);
    check_output_file("--out", options.out);
    const Strategy strategy = parse_strategy(options.strategy);
    const ReadyScene ready(options.scene, options.run);
    if (!ready.scene.camera)
        throw UsageError(options.scene + ": found no camera; a picture needs one");
    watch_for_interrupt();
    Progress progress(!options.run.quiet);
    const auto start = std::chrono::steady_clock::now();
    const ReadyStrategy<float> prepared(ready.lit, strategy, kernels<float>(), options.run.seed);
    const StopOptions& stop = options.stop;
    const Outcome outcome =
        stop.seconds || stop.error
            ? render_until(ready, prepared, stop, progress)
            : render_spp(ready, prepared, static_cast<std::uint64_t>(stop.spp.value_or(64)),
                         progress);
    progress.clear();
    if (outcome.shading_points == 0 && !outcome.is_partial)
        throw UsageError(no_points_message(ready.scene));
    write_exr(options.out, outcome.image,
              {{"Software", std::string("mis ") + MIS_VERSION},
               {"mis/command", options.run.command_line},
               {"mis/strategy", name_of(strategy)},
               {"mis/seed", std::to_string(options.run.seed)},
               {"mis/samples_per_point", std::to_string(outcome.samples)},
               {"mis/partial", outcome.is_partial ? "true" : "false"}});
    if (!options.run.quiet) {
        fmt::print(stderr,
                   "{}: {} x {} pixels, {} shading points, {} samples each by {}, {:.2f} s{}\n",
                   options.out, outcome.image.width, outcome.image.height, outcome.shading_points,
                   outcome.samples, name_of(strategy), seconds_since(start), interruption(outcome));
        if (outcome.error > 0)
            fmt::print(stderr, "relative error of the estimate: {:.3g} %\n", 100 * outcome.error);
        if (outcome.invalid > 0)
            fmt::print(stderr, "{} samples were not finite and count as 0\n", outcome.invalid);
    }
    return outcome.is_partial ? interrupted : ok;
}

}  // namespace mis::cli
