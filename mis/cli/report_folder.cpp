#include "mis/cli/report_folder.h"

#include "mis/cli/options.h"
#include "mis/io/atomic_file.h"
#include "mis/io/report_csv.h"
#include "mis/io/report_json.h"

#include <unistd.h>

#include <filesystem>

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

void write_report_folder(const Report& report, const std::string& folder, bool force)
{
    check_report_folder(folder, force);
    std::error_code error;
    fs::create_directory(folder, error);
    if (error) throw WriteError(folder + ": cannot be made: " + error.message());
    write_report_json(report, (fs::path(folder) / "report.json").string());
    write_report_csv(report, (fs::path(folder) / "strategies.csv").string());
}

}  // namespace mis::cli
