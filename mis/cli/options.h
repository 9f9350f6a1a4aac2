#pragma once

#include "mis/run/executor.h"
#include "mis/scene/scene.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace mis::cli {

/// Exit codes of every command.
enum Exit : int { ok = 0, failed = 1, usage = 2, interrupted = 130 };

/// A wrong command line. what() is the finished message: what was found, what is allowed.
struct UsageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What every command that runs takes: --threads, --seed, --quiet, --resolution, --effects,
/// --sampler.
struct RunOptions {
    int threads = 0;  ///< 0: as many as the machine has
    std::uint64_t seed = 1;
    bool quiet = false, verbose = false;
    std::string resolution;        ///< "WxH", or empty for the scene's
    std::string effects = "auto";  ///< auto, all, or NAME=off
    std::string sampler = "independent";
    bool names_sampler = false;  ///< else `strata` has its own
    std::string command_line;

    bool is_sobol() const { return sampler == "sobol"; }
};

/// Where figures go besides the table: --json and --csv.
struct OutputOptions {
    std::string json, csv;  ///< a file, "-" for standard output, or empty
};

/// Throws UsageError where a file of that name could not be made: before a run whose figures would
/// be lost.
void check_output_file(const std::string& option, const std::string& file);
void check(const OutputOptions& options);

/// --spp, --time, --error: when to stop; at most one is given.
struct StopOptions {
    std::optional<std::int64_t> spp;
    std::optional<double> seconds, error;
};

/// Throws UsageError unless the values make sense together; `least_spp` is the fewest samples the
/// command can use.
void check(const StopOptions& options, std::int64_t least_spp);

/// The effect that --effects NAME=off names; empty where it is auto or all.
std::string effect_off(const RunOptions& options);

/// The scene of that file at the resolution that was asked for. Throws SceneError and UsageError.
Scene read_scene_for(const std::string& file, const RunOptions& options);

/// What to say where the camera sees no surface.
std::string no_points_message(const Scene& scene);

/// What to say where shading normals were turned off their surface (PointCounts).
std::string turned_normals_message(std::size_t count);

inline constexpr int most_threads = 1024;

/// As many threads as asked for.
AnyExecutor make_executor(const RunOptions& options);

/// Throws UsageError: a word that is none of `known`, with the one that is nearest. what:
/// "--sampler: found", "found command".
/// kinds: what is known, in words; left out, the names themselves. meant: what to look for the
/// nearest to; left out, the word itself.
[[noreturn]] void refuse_name(const std::string& what, const std::string& found,
                              std::span<const std::string_view> known,
                              const std::string& kinds = "", const std::string& meant = "");

/// Throws UsageError unless --sampler is known.
void check_sampler(const RunOptions& options);

/// "a, b,c" → a b c; empty parts are refused by UsageError.
std::vector<std::string> split_list(const std::string& list, const std::string& option);

/// Processor and number of cores, in one line.
std::string machine_description();

}  // namespace mis::cli
