#include "mis/cli/report_folder.h"

#include "mis/cli/options.h"
#include "mis/io/atomic_file.h"
#include "mis/io/maps_exr.h"
#include "mis/io/page_pictures.h"
#include "mis/io/report_csv.h"
#include "mis/io/report_html.h"
#include "mis/io/report_json.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <vector>

namespace mis::cli {

namespace fs = std::filesystem;

void check_report_folder(const std::string& folder, bool force)
{
    std::error_code error;
    const fs::file_status status = fs::status(folder, error);
    if (fs::exists(status) && !fs::is_directory(status))
        throw UsageError("--out: found " + folder + ", which is a file; a folder is needed");
    if (fs::exists(status) && !force)
        throw UsageError("--out: found " + folder +
                         ", which exists; --force writes into it all the same");
    const fs::path parent = fs::exists(status)
                                ? fs::path(folder)
                                : fs::absolute(folder).lexically_normal().parent_path();
    if (!fs::is_directory(parent, error))
        throw UsageError("--out: there is no folder " + parent.string());
    if (access(parent.c_str(), W_OK) != 0)
        throw UsageError("--out: found " + parent.string() + ", which cannot be written to");
}

namespace {

bool is_maps_file(const fs::path& file)
{
    const std::string name = file.filename().string();
    return name == "maps.exr" || (name.starts_with("maps-") && name.ends_with(".exr"));
}

void remove_maps(const fs::path& folder)
{
    std::error_code ignored;
    std::vector<fs::path> old;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
        if (is_maps_file(entry.path())) old.push_back(entry.path());
    for (const fs::path& file : old) fs::remove(file, ignored);
}

void write_maps(const Report& report, std::span<const std::optional<Maps>> maps,
                const fs::path& folder)
{
    remove_maps(folder);
    for (std::size_t i = 0; i < maps.size(); ++i)
        if (maps[i])
            write_maps_exr(
                report, i, *maps[i],
                folder / (maps.size() == 1 ? "maps.exr" : fmt::format("maps-{}.exr", i + 1)));
}

std::vector<std::optional<PagePictures>> pictures_of(std::span<const std::optional<Maps>> maps)
{
    std::vector<std::optional<PagePictures>> pictures;
    for (const std::optional<Maps>& m : maps)
        pictures.push_back(
            m ? std::optional(page_pictures(*m, most_page_values / static_cast<double>(maps.size()),
                                            fmt::format("{}-", pictures.size())))
              : std::nullopt);
    return pictures;
}

}  // namespace

void write_report_folder(const Report& report, std::span<const std::optional<Maps>> maps,
                         const std::string& folder, bool force)
{
    check_report_folder(folder, force);
    std::error_code error;
    fs::create_directory(folder, error);
    if (error) throw WriteError(folder + ": cannot be made: " + error.message());
    write_report_json(report, (fs::path(folder) / "report.json").string());
    write_report_csv(report, (fs::path(folder) / "strategies.csv").string());
    write_report_html(report, pictures_of(maps), (fs::path(folder) / "report.html").string());
    write_maps(report, maps, folder);
}

}  // namespace mis::cli
