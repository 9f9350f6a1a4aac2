#include "mis/cli/options.h"

#include "mis/cli/interrupt.h"
#include "mis/effects/effects.h"
#include "mis/io/scene_json.h"
#include "mis/io/text_file.h"
#include "mis/run/tbb.h"
#include "mis/scene/nearest_name.h"
#include "mis/scene/text.h"
#include "mis/scene/validate.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

namespace mis::cli {

void check_output_file(const std::string& option, const std::string& file)
{
    namespace fs = std::filesystem;
    if (file.empty() || file == "-") return;
    std::error_code error;
    if (fs::is_directory(file, error))
        throw UsageError(option + ": found " + file + ", which is a folder; a file is needed");
    if (fs::exists(file, error)) return;  // written beside and renamed, or a pipe
    const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
    if (!fs::is_directory(folder, error))
        throw UsageError(option + ": there is no folder " + folder.string());
    if (access(folder.c_str(), W_OK) != 0)
        throw UsageError(option + ": found " + folder.string() +
                         ", a folder that cannot be written to");
}

void check(const OutputOptions& options)
{
    if (options.json == "-" && options.csv == "-")
        throw UsageError("--json and --csv: found - for both; standard output takes one of them");
    const auto place = [](const std::string& file) {
        std::error_code none;
        return std::filesystem::weakly_canonical(std::filesystem::absolute(file, none), none);
    };
    if (!options.json.empty() && !options.csv.empty() && place(options.json) == place(options.csv))
        throw UsageError(fmt::format(
            "--json and --csv: found {} for both; a file takes one of them", options.json));
    check_output_file("--json", options.json);
    check_output_file("--csv", options.csv);
}

void check(const StopOptions& options, std::int64_t least_spp)
{
    if (int{options.spp.has_value()} + int{options.seconds.has_value()} +
            int{options.error.has_value()} >
        1)
        throw UsageError(
            "--spp, --time and --error: found more than one; give one of them, or none");
    constexpr std::int64_t most_spp = std::int64_t{1} << 40;
    if (options.spp && (*options.spp < least_spp || *options.spp > most_spp))
        throw UsageError(
            fmt::format("--spp: found {}; {} to {} samples per shading point are allowed",
                        *options.spp, least_spp, most_spp));
    if (options.seconds && !(*options.seconds > 0 && *options.seconds <= 1e7))
        throw UsageError(fmt::format(
            "--time: found {} s; a time is greater than 0 and at most 1e7 s", *options.seconds));
    if (options.error && !(*options.error > 0 && *options.error < 10))
        throw UsageError(fmt::format(
            "--error: found {}; a relative error is greater than 0 and below 10", *options.error));
}

namespace {

std::array<int, 2> parse_resolution(const std::string& text)
{
    std::array<int, 2> size{};
    const char* const end = text.data() + text.size();
    const auto [x, error] = std::from_chars(text.data(), end, size[0]);
    bool is_good = error == std::errc{} && x != end && *x == 'x';
    if (is_good) {
        const auto [rest, error2] = std::from_chars(x + 1, end, size[1]);
        is_good = error2 == std::errc{} && rest == end;
    }
    const auto in_range = [](int n) { return n >= 1 && n <= limits::resolution; };
    if (!is_good || !in_range(size[0]) || !in_range(size[1]))
        throw UsageError(fmt::format(
            "--resolution: found \"{}\"; a resolution is WxH, each from 1 to {}, as in 256x171",
            text, limits::resolution));
    return size;
}

}  // namespace

std::string effect_off(const RunOptions& options)
{
    for (const char* name : effect_names)
        if (options.effects == name + std::string("=off")) return name;
    return "";
}

void refuse_name(const std::string& what, const std::string& found,
                 std::span<const std::string_view> known, const std::string& kinds,
                 const std::string& meant)
{
    const std::string_view near = nearest_name(meant.empty() ? found : meant, known);
    throw UsageError(fmt::format(
        "{} {}; known are {}{}", what, in_quotes(found), kinds.empty() ? comma_list(known) : kinds,
        near.empty() ? "" : fmt::format("\n    Did you mean \"{}\"?", near)));
}

void check_sampler(const RunOptions& options)
{
    constexpr std::array<std::string_view, 2> known{"independent", "sobol"};
    if (std::find(known.begin(), known.end(), options.sampler) == known.end())
        refuse_name("--sampler: found", options.sampler, known);
}

namespace {

/// Throws UsageError unless --effects is known.
void check_effects(const RunOptions& options)
{
    if (options.effects == "auto" || options.effects == "all" || !effect_off(options).empty())
        return;
    std::vector<std::string> off;
    for (const char* name : effect_names) off.push_back(name + std::string("=off"));
    std::vector<std::string_view> known{"auto", "all"};
    known.insert(known.end(), off.begin(), off.end());
    const std::string kinds =
        fmt::format("auto, all, and NAME=off with a name of {}", fmt::join(effect_names, ", "));
    const bool is_near = !nearest_name(options.effects, known).empty();
    refuse_name("--effects: found", options.effects, known, kinds,
                is_near ? options.effects : options.effects + "=off");
}

}  // namespace

Scene read_scene_for(const std::string& file, const RunOptions& options)
{
    check_effects(options);
    check_sampler(options);
    const std::optional<std::array<int, 2>> resolution =
        options.resolution.empty() ? std::nullopt
                                   : std::optional(parse_resolution(options.resolution));
    Scene scene = read_scene(file, interrupt_token());
    if (resolution) {
        if (!scene.camera)
            throw UsageError("--resolution: " + file + " has no camera, so it has no picture");
        scene.camera->resolution = *resolution;
    }
    return scene;
}

std::string no_points_message(const Scene& scene)
{
    return scene.file +
           ": /camera: found no surface in view; a picture needs one to be lit\n"
           "    Turn the camera, add surfaces, or give probes without a camera.";
}

std::string turned_normals_message(std::size_t count)
{
    return fmt::format("{} away from the viewer, and {} turned to him\n",
                       many(count, "shading normal") + (count == 1 ? " leans" : " lean"),
                       count == 1 ? "is" : "are");
}

AnyExecutor make_executor(const RunOptions& options)
{
    return any_executor(TbbExecutor(options.threads));
}

std::vector<std::string> split_list(const std::string& list, const std::string& option)
{
    std::vector<std::string> parts;
    std::size_t start = 0;
    while (start <= list.size()) {
        const std::size_t comma = std::min(list.find(',', start), list.size());
        const std::size_t first = list.find_first_not_of(" \t", start);
        const std::size_t last = list.find_last_not_of(" \t", comma == 0 ? 0 : comma - 1);
        if (comma == start || first >= comma || last == std::string::npos)
            throw UsageError(option + ": found \"" + list +
                             "\"; a list is names separated by commas");
        parts.push_back(list.substr(first, last - first + 1));
        start = comma + 1;
    }
    return parts;
}

std::string machine_description()
{
    std::ifstream info("/proc/cpuinfo");
    std::string line, model = "unknown processor";
    while (std::getline(info, line)) {
        if (line.rfind("model name", 0) != 0) continue;
        const std::size_t colon = line.find(':');
        if (colon != std::string::npos && colon + 2 <= line.size()) model = line.substr(colon + 2);
        break;
    }
    return fmt::format("{}, {} cores", model, std::thread::hardware_concurrency());
}

}  // namespace mis::cli
