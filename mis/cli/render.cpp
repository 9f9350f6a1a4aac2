#include "mis/cli/commands.h"

#include "mis/cli/interrupt.h"
#include "mis/cli/progress.h"
#include "mis/cli/ready.h"
#include "mis/cli/remark.h"
#include "mis/cli/strategy_list.h"
#include "mis/engine/exact.h"
#include "mis/engine/render.h"
#include "mis/engine/stopwatch.h"
#include "mis/io/image_exr.h"
#include "mis/scene/text.h"
#include "mis/stats/resolved.h"
#include "mis/strategy/strategy.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>

namespace mis::cli {

namespace {

/// How far off the picture is: √ of the mean of variance/n/(μ² + ε²) over its points (design §1),
/// and how many samples carry that.
struct PictureError {
    double relative = 0;
    Participation participation;

    bool is_dark() const { return participation.sum_d2 == 0; }
    bool is_resolved() const { return is_dark() || participation.number() >= least_participation; }
};

/// μ is a point's own mean or its tile's, whichever gives more: where few points have been hit at
/// all, their own means are far too high, and the others' variances look like 0.
PictureError error_of(const Band& band)
{
    PictureError error;
    double mean = 0;
    for (const PointResult& result : band.results) mean += result.luminance.mean;
    const auto points = static_cast<double>(band.results.size() + band.shading.dark.size());
    if (points == 0) return error;
    const double epsilon2 = square(0.01 * mean / points);
    double by_point = 0, by_tile = 0;
    for (const Tile& tile : band.shading.tiles) {
        double tile_mean = 0, variance = 0;
        for (const PointResult& result : std::span(band.results).subspan(tile.first, tile.count)) {
            const Moments& m = result.luminance;
            tile_mean += m.mean / tile.count;
            if (!(m.m2 > 0)) continue;
            const double weight = 1 / (square(m.mean) + epsilon2);
            const double own = m.variance() / static_cast<double>(m.count);
            variance += own;
            by_point += own * weight;
            error.participation.sum_d2 += m.m2 * weight;
            error.participation.sum_d4 += m.m4 * weight * weight;
        }
        if (variance > 0) by_tile += variance / (square(tile_mean) + epsilon2);
    }
    error.relative = std::sqrt(std::max(by_point, by_tile) / points);
    return error;
}

/// What a render comes to, whichever way it stopped.
struct Outcome {
    Image image;
    std::uint64_t samples = 0, invalid = 0;  ///< samples: per shading point
    std::size_t shading_points = 0;
    std::size_t turned_normals = 0;
    std::optional<PictureError> error;  ///< not of a picture in several bands
    bool is_partial = false;
    std::optional<int> unlit_from;  ///< first row without samples, where interrupted before them
};

Image black_picture(const Camera& camera)
{
    const auto [width, height] = camera.resolution;
    return {
        width, height,
        std::vector<Vec3<float>>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                                 Vec3<float>(0.0F))};
}

/// Rows that are found and lit at a time, so that memory does not grow with the picture.
int rows_of_band(const Camera& camera)
{
    constexpr int band_pixels = 1 << 20;
    const auto [width, height] = camera.resolution;
    return std::clamp(band_pixels / width / tile_side * tile_side, tile_side, height + tile_side);
}

/// Some rows' points; nothing where that is interrupted and rows before them are lit. Throws
/// Stopped where none are.
std::optional<Band> next_band(const ReadyScene& ready, int row, int rows)
{
    try {
        return find_band(ready.lit, row, rows, ready.stoppable_executor());
    } catch (const Stopped&) {
        if (row == 0) throw;
        return std::nullopt;
    }
}

/// The closed form at every point; refused where some have none.
Outcome render_exactly(const ReadyScene& ready, Progress& progress)
{
    Outcome outcome;
    outcome.image = black_picture(*ready.scene.camera);
    const int height = outcome.image.height, band_rows = rows_of_band(*ready.scene.camera);
    ExactShare share;
    for (int row = 0; row < height && !outcome.is_partial; row += band_rows) {
        std::optional<Band> next = next_band(ready, row, std::min(band_rows, height - row));
        if (!next) {
            outcome.is_partial = true, outcome.unlit_from = row;
            break;
        }
        Band& band = *next;
        const ExactShare here = exact_share(ready.lit, band.shading);
        share.exact += here.exact, share.points += here.points;
        share.exact_tiles += here.exact_tiles, share.tiles += here.tiles;
        outcome.turned_normals += band.shading.counts.turned_normals;
        if (share.is_all()) {
            light_exactly(ready.lit, band, ready.stoppable_executor());
            draw_band(ready.lit, band, outcome.image);
        }
        progress.show("rendering", (row + double(band.shading.rows)) / height);
        outcome.is_partial = interrupt_flag();
        if (outcome.is_partial) outcome.unlit_from = row + band.shading.rows;
    }
    if (!share.is_all())
        throw UsageError(fmt::format(
            "--strategy exact: {} of the {} of {}, in {} of {}, have a closed "
            "form, and all must: surfaces without a lobe, and no surface and no other light that "
            "may stand before any light; `mis explain` says why one may\n"
            "    `mis predict` has exact values of probes on any material.",
            share.exact, many(share.points, "shading point"), ready.scene.file, share.exact_tiles,
            many(share.tiles, "tile")));
    outcome.shading_points = share.points;
    return outcome;
}

/// Has every point a sample?
bool is_lit_throughout(const Band& band) { return band.results.empty() || least_samples(band) > 0; }

/// A given number of samples.
Outcome render_spp(const ReadyScene& ready, const ReadyStrategy<float>& strategy, std::uint64_t spp,
                   Progress& progress)
{
    Outcome outcome;
    outcome.image = black_picture(*ready.scene.camera);
    const int height = outcome.image.height, band_rows = rows_of_band(*ready.scene.camera);
    outcome.samples = spp;
    WorkspacePool<float> workspaces;
    for (int row = 0; row < height && !outcome.is_partial; row += band_rows) {
        std::optional<Band> next = next_band(ready, row, std::min(band_rows, height - row));
        if (!next) {
            outcome.is_partial = true, outcome.unlit_from = row;
            break;
        }
        Band& band = *next;
        const auto each = static_cast<std::uint64_t>(samples_together(strategy.strategy()));
        const std::uint64_t step = std::max<std::uint64_t>(16 / each, 1) * each;
        for (std::uint64_t s = 0; s < spp && !outcome.is_partial; s += step) {
            const int count = static_cast<int>(std::min(step, spp - s));
            outcome.invalid +=
                light_band(strategy, band, s, count, workspaces, ready.executor, interrupt_token())
                    .invalid;
            outcome.is_partial = interrupt_flag();
            progress.show(
                "rendering",
                (row + double(band.shading.rows) * double(s + step) / double(spp)) / height);
        }
        if (outcome.is_partial && !is_lit_throughout(band)) {
            if (row == 0) throw Stopped();
            outcome.unlit_from = row;
            break;
        }
        outcome.shading_points += band.results.size() + band.shading.dark.size();
        outcome.turned_normals += band.shading.counts.turned_normals;
        draw_band(ready.lit, band, outcome.image);
        if (band.shading.rows == height) {
            if (!band.results.empty()) outcome.samples = least_samples(band);
            outcome.error = error_of(band);
        } else if (outcome.is_partial) {
            outcome.unlit_from = row + band.shading.rows;
        }
    }
    return outcome;
}

/// Up once interrupted and, where a time was given, once that is over.
StopToken until_time(const StopOptions& stop, Clock::time_point start)
{
    if (!stop.seconds) return interrupt_token();
    return interrupt_token().until(start + std::chrono::duration_cast<Clock::duration>(
                                               std::chrono::duration<double>(*stop.seconds)));
}

std::string no_time_message(double seconds, const std::string& file)
{
    return fmt::format(
        "--time: found {}; in so many seconds not every shading point of {} had its first "
        "sample\n    Give more time, or a lower --resolution.",
        seconds, file);
}

/// The most samples that are whole observations.
int in_whole_observations(double samples, const ReadyStrategy<float>& strategy)
{
    const int each = samples_together(strategy.strategy());
    return static_cast<int>(samples) / each * each;
}

/// Until a time or an error is reached: all of the picture at once, in doubling rounds. To an error
/// by Sobol' sequences, all rounds double, so that the samples are a power of two. start: of the
/// time.
Outcome render_until(const ReadyScene& ready, const ReadyStrategy<float>& strategy,
                     const StopOptions& stop, bool is_sobol, Clock::time_point start,
                     Progress& progress)
{
    Outcome outcome;
    outcome.image = black_picture(*ready.scene.camera);
    WorkspacePool<float> workspaces;
    const StopToken token = until_time(stop, start);
    Band band = find_band(ready.lit, 0, outcome.image.height, ready.stoppable_executor());
    outcome.shading_points = band.results.size() + band.shading.dark.size();
    outcome.turned_normals = band.shading.counts.turned_normals;
    const int each = samples_together(strategy.strategy());
    int count = (stop.seconds ? 1 : 4) * each;
    bool is_done = false;
    while (!is_done) {
        const auto round = Clock::now();
        outcome.invalid +=
            light_band(strategy, band, outcome.samples, count, workspaces, ready.executor, token)
                .invalid;
        outcome.samples += static_cast<std::uint64_t>(count);
        outcome.is_partial = interrupt_flag();
        if (!is_lit_throughout(band)) {
            if (outcome.is_partial) throw Stopped();
            throw UsageError(no_time_message(*stop.seconds, ready.scene.file));
        }
        outcome.error = error_of(band);
        const double seconds_per_sample = seconds_since(round) / count;
        if (stop.seconds) {
            const double left = *stop.seconds - seconds_since(start);
            count = in_whole_observations(std::clamp(left / seconds_per_sample, 0.0, 64.0 * each),
                                          strategy);
            is_done = count == 0;
            progress.show("rendering", seconds_since(start) / *stop.seconds);
        } else {
            const double wanted = *stop.error;
            const double error = outcome.error->relative;
            constexpr std::uint64_t enough_of_darkness = 1024;  // all samples 0: it may well be 0
            is_done = outcome.error->is_dark() ? outcome.samples >= enough_of_darkness
                                               : outcome.error->is_resolved() && error <= wanted;
            const double needed =
                outcome.error->is_resolved()
                    ? double(outcome.samples) * (error * error / (wanted * wanted) - 1)
                    : double(outcome.samples);
            count = in_whole_observations(
                std::clamp(needed, double(each), std::min(64.0 * each, double(outcome.samples))),
                strategy);
            if (is_sobol && each == 1)
                count = static_cast<int>(std::min<std::uint64_t>(outcome.samples, 1 << 20));
            progress.show("rendering", error > 0 ? wanted * wanted / (error * error) : 0);
        }
        is_done = is_done || outcome.is_partial || band.results.empty();
    }
    if (!band.results.empty()) outcome.samples = least_samples(band);
    draw_band(ready.lit, band, outcome.image);
    return outcome;
}

std::string in_words(const PictureError& error)
{
    if (error.is_dark())
        return "relative error of the estimate: unknown, all samples of a point agree, or there is "
               "but one";
    if (!error.is_resolved())
        return fmt::format(
            "relative error of the estimate: not resolved, {:.0f} samples carry it and "
            "{:.0f} are needed",
            error.participation.number(), least_participation);
    return fmt::format("relative error of the estimate: {:.3g} %", 100 * error.relative);
}

std::string interruption(const Outcome& outcome)
{
    if (!outcome.is_partial) return "";
    if (!outcome.unlit_from) return " (partial: interrupted)";
    return fmt::format(" (partial: interrupted; its last rows have fewer, and from row {} none)",
                       *outcome.unlit_from);
}

/// By samples.
Outcome render_by(const Strategy& strategy, const ReadyScene& ready, const RenderOptions& options,
                  Progress& progress)
{
    const bool is_sobol = options.run.is_sobol();
    const Clock::time_point start = Clock::now();
    NumberSource numbers(options.run.seed, is_sobol ? one_scrambling : 0);
    numbers.is_asked_for = options.run.names_sampler;
    const ReadyStrategy<float> prepared(ready.lit, strategy, kernels<float>(), numbers, {},
                                        interrupt_token());
    const StopOptions& stop = options.stop;
    if (stop.seconds || stop.error)
        return render_until(ready, prepared, stop, is_sobol, start, progress);
    const auto spp = static_cast<std::uint64_t>(stop.spp.value_or(64));
    ready.lit.expect_samples(static_cast<double>(spp));
    return render_spp(ready, prepared, spp, progress);
}

/// strategy: none where it is exact.
void print_outcome(const Outcome& outcome, const std::optional<Strategy>& strategy,
                   const RenderOptions& options, double seconds)
{
    const std::string how =
        strategy ? fmt::format("{} each by {}", many(outcome.samples, "sample"), name_of(*strategy))
                 : "each by its closed form";
    remark("{}: {} x {} pixels, {}, {}, {:.2f} s{}\n", options.out, outcome.image.width,
           outcome.image.height, many(outcome.shading_points, "shading point"), how, seconds,
           interruption(outcome));
    const bool is_sobol = strategy && options.run.is_sobol() && strategy->model != Model::strata;
    if (outcome.error)
        remark("{}{}\n", in_words(*outcome.error),
               is_sobol ? ", were its samples independent" : "");
    if (is_sobol && !std::has_single_bit(outcome.samples) && !outcome.is_partial)
        remark("{}: a Sobol' sequence spreads most evenly at powers of two\n",
               many(outcome.samples, "sample"));
    if (outcome.turned_normals > 0) remark("{}", turned_normals_message(outcome.turned_normals));
    if (outcome.invalid > 0)
        remark("{} {} NaN or infinite, and counted as 0\n", many(outcome.invalid, "sample"),
               outcome.invalid == 1 ? "was" : "were");
}

/// Where the numbers came from: `strata` draws from sequences unless it is told not to.
std::string sampler_of(const std::optional<Strategy>& strategy, const RunOptions& run)
{
    const bool has_own = strategy && strategy->model == Model::strata && !run.names_sampler;
    return has_own ? "sobol" : run.sampler;
}

/// `strata` without a number has all of --spp, or 64, draws together; with one, --spp is some times
/// that.
Strategy with_draws(Strategy strategy, const StopOptions& stop)
{
    if (strategy.model != Model::strata) return strategy;
    constexpr int by_default = 64;
    const auto spp = static_cast<std::uint64_t>(stop.spp.value_or(by_default));
    const auto each = static_cast<std::uint64_t>(strategy.counts[0]);
    if (each == 0 && spp > most_strata_draws)
        throw UsageError(
            fmt::format("--spp: found {}; strata has at most {} draws together\n    "
                        "Say strata@N, of which --spp is a multiple.",
                        spp, most_strata_draws));
    if (each == 0) return strata(static_cast<int>(spp));
    if (stop.spp && spp % each != 0)
        throw UsageError(
            fmt::format("--spp: found {}; {} has {} samples together, so --spp is {} "
                        "times some whole number\n    Or say \"strata\" alone.",
                        spp, name_of(strategy), each, each));
    return strategy;
}

}  // namespace

int run_render(const RenderOptions& options)
{
    check(options.stop, 1);
    if (!options.out.ends_with(".exr"))
        throw UsageError(fmt::format(
            "--out: found \"{}\"; the picture is an OpenEXR file: its name ends in .exr",
            options.out));
    check_output_file("--out", options.out);
    const bool is_exact = options.strategy == "exact";
    const StopOptions& stop = options.stop;
    if (is_exact && (stop.spp || stop.seconds || stop.error))
        throw UsageError("--strategy exact: it takes no samples; leave out --spp, --time, --error");
    if (is_exact && options.run.effects == "all")
        throw UsageError("--strategy exact: it needs the proofs of --effects auto");
    const std::optional<Strategy> strategy =
        is_exact ? std::nullopt : std::optional(with_draws(parse_strategy(options.strategy), stop));
    const ReadyScene ready(options.scene, options.run);
    if (strategy) check_lights(*strategy, ready.scene.lights.size());
    if (!ready.scene.camera)
        throw UsageError(options.scene + ": found no camera; a picture needs one");
    Progress progress(!options.run.quiet);
    const auto start = Clock::now();
    const Outcome outcome =
        strategy ? render_by(*strategy, ready, options, progress) : render_exactly(ready, progress);
    progress.clear();
    if (outcome.shading_points == 0 && !outcome.is_partial)
        throw UsageError(no_points_message(ready.scene));
    write_exr(options.out, outcome.image,
              ExrMetadata(MIS_VERSION, options.run.command_line, options.run.seed)
                  .add("scene", ready.scene.name)
                  .add("strategy", strategy ? name_of(*strategy) : "exact")
                  .add("sampler", sampler_of(strategy, options.run))
                  .add("samples_per_point", std::to_string(outcome.samples))
                  .add("partial", outcome.is_partial ? "true" : "false"));
    if (!options.run.quiet) print_outcome(outcome, strategy, options, seconds_since(start));
    return outcome.is_partial ? interrupted : ok;
}

}  // namespace mis::cli
