#include "mis/io/scene_file.h"

#include "mis/io/text_file.h"
#include "mis/scene/nearest_name.h"

#include <algorithm>
#include <system_error>

namespace mis {

std::filesystem::path referenced_file(const JsonNode& name)
{
    const std::string& written = name.string();
    const std::string allowed =
        "a path is relative to the scene file's folder, and names a file that exists";
    if (written.empty() || written.find('\0') != written.npos)
        name.fail_value(allowed, "Write the name of a file.");
    if (std::any_of(written.begin(), written.end(), [](char c) { return c > '\0' && c < ' '; }))
        name.fail(
            in_quotes(written) + ", which has a control character in it", allowed,
            "In a string \\t and the like are one character. Write paths with /, or each \\ as "
            "\\\\.");
    const std::filesystem::path file = std::filesystem::path(name.file()).parent_path() / written;
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status))
        name.fail(in_quotes(written) + ", which does not exist", allowed,
                  "It was looked for at " + in_quotes(file.string()) + ".");
    if (!std::filesystem::is_regular_file(status))
        name.fail(in_quotes(written) + ", which is a directory or a device", allowed,
                  "Name a file in it.");
    return file;
}

std::string_view read_type(const JsonNode& type, std::span<const std::string_view> known)
{
    const std::string& written = type.string();
    const auto found = std::find(known.begin(), known.end(), written);
    if (found == known.end())
        type.fail(in_quotes(written), "known types are " + comma_list(known),
                  did_you_mean(written, known, "Use one of these."));
    return *found;
}

}  // namespace mis
